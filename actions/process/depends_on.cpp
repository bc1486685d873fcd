// SPDX-License-Identifier: Apache-2.0
#include "actions/process/depends_on.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launch {

namespace {

void require_state(const Fields& fields, const std::string& attribute, const std::string& state, bool is_state) {
  if (fields.has(attribute) && !is_state) {
    throw LaunchError(fmt::format("{} goes with condition=\"{}\" only", attribute, state), fields.where(attribute), {},
                      Finding::kExclusive);
  }
}

}  // namespace

ItemSpec DependsOn::item() {
  ItemSpec spec = item_of_fault();
  spec.help = "a condition for the start of the process, which waits until all its conditions hold";
  const auto occurrence = std::find_if(spec.attributes.begin(), spec.attributes.end(),
                                       [](const AttributeSpec& each) { return each.name == "occurrence"; });
  occurrence->help = "with output: how many such lines there must be";
  spec.attributes.push_back({"on_failure", AttributeType::kLiteral, false, "shutdown",
                             "what follows when the condition can no longer hold: shutdown of the system, start of the "
                             "process all the same, or "
                             "skip (the process never starts)",
                             true});
  return spec;
}

ItemSpec DependsOn::item_of_fault() {
  std::vector<AttributeSpec> attributes = {
      {"process", AttributeType::kText, false, "", "another process, by its name or that of its node", true}};
  for (AttributeSpec& attribute : ros_condition_attributes()) {
    attributes.push_back(std::move(attribute));
  }
  const std::vector<AttributeSpec> rest = {
      {"condition", AttributeType::kLiteral, false, "started; present",
       "with process: started, exited, output or healthy; with topic: present or message; else present", true},
      {"exit_code", AttributeType::kText, false, "0",
       "with exited: any, nonzero, or codes and signals separated by commas", true},
      {"pattern", AttributeType::kText, false, "any line", "with output: regular expression to be found in a line",
       true},
      {"stream", AttributeType::kText, false, "both", "with output: stdout, stderr or both", true},
      {"occurrence", AttributeType::kText, false, "1",
       "with output: how many such lines there must be, or a range such as 2..9, from which one is drawn", true},
      {"timeout", AttributeType::kFloat, false, "none", "seconds after which the condition counts as failed", true}};
  attributes.insert(attributes.end(), rest.begin(), rest.end());
  return {.tag = "depends_on",
          .help = "a condition for the fault, which waits until all its conditions hold",
          .attributes = std::move(attributes),
          .has_condition = true,
          .extension = true};
}

DependsOn::DependsOn(const Fields& fields)
    : fields_(fields),
      subject_(ros_subject_of(fields, {"process"})),
      on_failure_(static_cast<OnFailure>(choice(fields, "on_failure", {"shutdown", "start", "skip"}))) {
  if (subject_ == "process") {
    state_ = static_cast<State>(choice(fields, "condition", {"started", "exited", "output", "healthy"}));
    for (const char* const of_node : {"state", "parameter", "value"}) {
      if (fields.has(of_node)) {
        throw LaunchError(fmt::format("{} goes with a node only", of_node), fields.where(of_node), {},
                          Finding::kExclusive);
      }
    }
  } else {
    check_ros_condition(fields, subject_);
  }
  require_state(fields, "exit_code", "exited", state_ == State::kExited);
  require_state(fields, "pattern", "output", state_ == State::kOutput);
  require_state(fields, "stream", "output", state_ == State::kOutput);
  require_state(fields, "occurrence", "output", state_ == State::kOutput);
  if (std::optional<NumberField> timeout = fields.number("timeout")) {
    timeout->require_not_negative();
  }
  check_range(fields, "occurrence", RangeOf::kWholeNumbersFromOne);
}

NumberRange DependsOn::occurrence(Scope& scope) const {
  return fields_.has("occurrence") ? perform_range(fields_, "occurrence", scope, RangeOf::kWholeNumbersFromOne)
                                   : NumberRange{1, 1};
}

void DependsOn::request(LaunchContext& context, std::size_t process) const {
  Scope& scope = context.scope();
  if (!fields_.condition().holds(scope)) {
    return;
  }
  const NumberRange number = occurrence(scope);
  if (number.is_random()) {
    throw LaunchError("only the depends_on of a <fault> draws a number of a range", fields_.where("occurrence"),
                      "give one number", Finding::kExclusive);
  }
  Dependency made = dependency(context, static_cast<std::uint64_t>(number.from));
  made.process = process;
  context.requests().dependencies.push_back(std::move(made));
}

std::optional<Dependency> DependsOn::perform(LaunchContext& context, const FaultDraw& draw, std::size_t number) const {
  Scope& scope = context.scope();
  if (!fields_.condition().holds(scope)) {
    return std::nullopt;
  }
  return dependency(context, draw.whole(fmt::format("occurrence {}", number), occurrence(scope)));
}

bool DependsOn::is_random(Scope& scope) const {
  return occurrence(scope).is_random();
}

Dependency DependsOn::dependency(LaunchContext& context, std::uint64_t occurrence) const {
  Scope& scope = context.scope();
  Dependency dependency;
  if (subject_ == "process") {
    dependency.condition = process_condition(scope, occurrence);
  } else {
    dependency.condition = perform_ros_condition(fields_, subject_, context);
  }
  if (std::optional<NumberField> timeout = fields_.number("timeout")) {
    timeout->require_not_negative();
    dependency.timeout = as_duration(timeout->perform(scope));
  }
  dependency.on_failure = on_failure_;
  dependency.where = fields_.where();
  return dependency;
}

ProcessCondition DependsOn::process_condition(Scope& scope, std::uint64_t occurrence) const {
  ProcessCondition condition;
  condition.process = fields_.text("process").perform(scope);
  switch (state_) {
    case State::kStarted:
      condition.state = UntilStarted{};
      break;
    case State::kExited:
      condition.state = UntilExited{ExitCodeFilter(
          fields_.has("exit_code") ? fields_.text("exit_code").perform(scope) : "0", fields_.where("exit_code"))};
      break;
    case State::kOutput:
      condition.state = UntilOutput{perform_output_pattern(fields_, scope), occurrence};
      break;
    case State::kHealthy:
      condition.state = UntilHealthy{};
      break;
  }
  return condition;
}

}  // namespace launch
