// SPDX-License-Identifier: Apache-2.0
// <stop>, <restart>, <signal>, <set_priority> and <restore_priority>: what is done to running processes, and
// <shutdown/>, which ends the whole launch.
#include <algorithm>
#include <array>

#include "actions/process/resource_settings.hpp"
#include "actions/row_action.hpp"
#include "launcher/language/exit_code_filter.hpp"

namespace launch {

namespace {

ActionType command(ProcessCommand::Kind kind, std::string help, std::vector<Setting<ProcessCommand>> more = {},
                   void (*check)(const Fields&) = nullptr) {
  std::vector<Setting<ProcessCommand>> rows = {
      {.attribute = {"process", AttributeType::kText, true, "",
                     "name of the process or of its node; all processes of that name are meant", true},
       .place = place_of(&ProcessCommand::process)}};
  rows.insert(rows.end(), more.begin(), more.end());
  return action_of<ProcessCommand>(
      {.tag = std::string(name_of(kind)), .help = std::move(help), .extension = true}, std::move(rows),
      [kind](const Fields& fields, LaunchContext& context, ProcessCommand& command) {
        command.kind = kind;
        command.where = fields.text("process").where();
        context.requests().commands.push_back(std::move(command));
      },
      check);
}

// The attributes of a process that can be changed while it runs.
constexpr std::array<const char*, 4> kScheduling = {"nice", "sched_policy", "sched_priority", "cpus"};

std::vector<Setting<ProcessCommand>> scheduling_rows() {
  std::vector<Setting<ProcessCommand>> rows;
  for (const Setting<ResourceLimits>& setting : resource_settings()) {
    if (std::find(kScheduling.begin(), kScheduling.end(), setting.attribute.name) == kScheduling.end()) {
      continue;
    }
    Setting<ProcessCommand>& row = rows.emplace_back();
    row.attribute = setting.attribute;
    row.attribute.default_value = "as it is";
    row.checks_literal = setting.checks_literal;
    row.perform = [perform = setting.perform](const Fields& fields, Scope& scope, ProcessCommand& command) {
      perform(fields, scope, command.scheduling);
      if (command.scheduling.policy == kDeadlinePolicy) {
        throw LaunchError("a process that runs can't get the policy deadline", fields.where("sched_policy"),
                          "give it to the process itself, where it is started");
      }
    };
  }
  return rows;
}

void check_scheduling(const Fields& fields) {
  const bool is_said =
      std::any_of(kScheduling.begin(), kScheduling.end(), [&](const char* attribute) { return fields.has(attribute); });
  if (!is_said) {
    throw LaunchError("it is not said what changes", fields.where(),
                      "give nice=\"…\", sched_policy=\"…\" or cpus=\"…\"", Finding::kMissingAttribute);
  }
}

}  // namespace

ActionType stop_action() {
  return command(
      ProcessCommand::Kind::kStop,
      "Ends a running process as a shutdown would; it does not respawn. A process that still waits for others "
      "never starts.");
}

ActionType restart_action() {
  return command(ProcessCommand::Kind::kRestart,
                 "Ends a process as a shutdown would and starts it again; a process that has ended is only started.");
}

ActionType signal_action() {
  return command(
      ProcessCommand::Kind::kSignal, "Sends a signal to a running process and its descendants.",
      {{.attribute = {"signal", AttributeType::kText, true, "", "its name or its number, such as SIGUSR1", true},
        .perform =
            [](const Fields& fields, Scope& scope, ProcessCommand& command) {
              command.signal = signal_of(fields.text("signal").perform(scope), fields.text("signal").where());
            },
        .checks_literal = true}});
}

ActionType set_priority_action() {
  return command(ProcessCommand::Kind::kSetPriority,
                 "Changes how all threads of a running process and of its descendants get processors, until it ends or "
                 "restore_priority gives them what they had.",
                 scheduling_rows(), check_scheduling);
}

ActionType restore_priority_action() {
  return command(ProcessCommand::Kind::kRestorePriority,
                 "Gives the threads of a process what they had before the first set_priority.");
}

ActionType shutdown_action() {
  return action_of<ShutdownRequest>(
      {.tag = "shutdown", .help = "Ends the whole launch once everything around it has been visited."},
      {{.attribute = {"reason", AttributeType::kText, false, "", "why, for the launch log"},
        .place = place_of(&ShutdownRequest::reason)}},
      [](const Fields& fields, LaunchContext& context, ShutdownRequest& shutdown) {
        shutdown.where = fields.where();
        context.requests().shutdowns.push_back(std::move(shutdown));
      });
}

}  // namespace launch
