// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/event_handler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace launch {

namespace {

struct Description {
  std::string operator()(const OnProcessStart&) const { return "on_process_start" + of_process(); }
  std::string operator()(const OnProcessExit& exit) const {
    return fmt::format("on_process_exit{} with exit code {}", of_process(), exit.exit_code.text());
  }
  std::string operator()(const OnProcessIo& io) const {
    return fmt::format("on_process_io{} with {}", of_process(), io.pattern.describe());
  }
  std::string operator()(const OnHealthChange& change) const {
    return fmt::format("on_health_change{}{}", of_process(),
                       change.health ? fmt::format(" to {}", name_of(*change.health)) : std::string());
  }
  std::string operator()(const OnStartLimit&) const { return "on_start_limit" + of_process(); }
  std::string operator()(const OnMachineLost& lost) const {
    return lost.machine.empty() ? "on_machine_lost of any machine"
                                : fmt::format("on_machine_lost of machine '{}'", lost.machine);
  }
  std::string operator()(const OnMachineBack& back) const {
    return back.machine.empty() ? "on_machine_back of any machine"
                                : fmt::format("on_machine_back of machine '{}'", back.machine);
  }
  std::string operator()(const OnShutdown&) const { return "on_shutdown"; }
  std::string operator()(const OnStateTransition& transition) const {
    std::string text = fmt::format("on_state_transition of '{}'", transition.node);
    text += transition.start_state.empty() ? "" : " from " + transition.start_state;
    return text + (transition.goal_state.empty() ? "" : " to " + transition.goal_state);
  }
  std::string operator()(const OnCondition& wanted) const { return tracing::describe(wanted.condition); }
  std::string operator()(const OnceReady& ready) const { return "once " + ready.condition->describe(); }

  std::string of_process() const { return process.empty() ? " of any process" : fmt::format(" of '{}'", process); }
  const std::string& process;
};

}  // namespace

std::string describe(const EventHandler& handler) {
  return std::visit(Description{handler.process}, handler.event);
}

EventValues values_of(const OnCondition& wanted, const tracing::ConditionChange& change) {
  using tracing::LiveCondition;
  const LiveCondition& condition = wanted.condition;
  if (is_of_process(condition)) {
    const char* const what = condition.kind == LiveCondition::Kind::kMemory   ? "memory"
                             : condition.kind == LiveCondition::Kind::kGrowth ? "growth"
                                                                              : "share";
    return {{"process", fmt::format("{}", fmt::join(change.processes, ", "))},
            {what, fmt::format("{:.10g}", change.figure)},
            {"above", fmt::format("{:.10g}", condition.above.value_or(0))},
            {condition.kind == LiveCondition::Kind::kGrowth ? "window" : "for", tracing::time_text(condition.window)}};
  }
  EventValues values = {{name_of(condition.subject), condition.name},
                        {"process", fmt::format("{}", fmt::join(change.processes, ", "))}};
  if (condition.kind == LiveCondition::Kind::kSilence) {
    values.emplace_back("for", tracing::time_text(condition.window));
    return values;
  }
  if (condition.kind == LiveCondition::Kind::kLoss) {
    values.emplace_back("lost", fmt::format("{:.0f}", change.figure));
    values.emplace_back("share", fmt::format("{:.6g}", change.late));
    values.emplace_back("above", fmt::format("{:.6g}", 1 - condition.share));
    values.emplace_back("window", tracing::time_text(condition.window));
    return values;
  }
  if (condition.kind == LiveCondition::Kind::kLate) {
    values.emplace_back("took", fmt::format("{:.6g}", change.figure));
    values.emplace_back("max", tracing::time_text(condition.max));
    values.emplace_back("share", fmt::format("{:.6g}", 1 - change.late));
    values.emplace_back("window", tracing::time_text(condition.window));
    return values;
  }
  values.emplace_back("rate", fmt::format("{:.4g}", change.figure));
  values.emplace_back("window", tracing::time_text(condition.window));
  values.emplace_back(condition.below ? "below" : "above",
                      fmt::format("{:.10g}", condition.below ? *condition.below : condition.above.value_or(0)));
  return values;
}

Scope Invocation::with_values(Scope scope, const EventValues& values) {
  for (const auto& [name, value] : values) {
    scope.configurations.insert_or_assign("event." + name, value);
  }
  return scope;
}

}  // namespace launch
