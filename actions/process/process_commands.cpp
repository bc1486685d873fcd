// SPDX-License-Identifier: Apache-2.0
// <stop>, <restart> and <signal>: what is done to running processes, and <shutdown/>, which ends the whole launch.
#include "actions/row_action.hpp"
#include "launcher/language/exit_code_filter.hpp"

namespace launch {

namespace {

ActionType command(ProcessCommand::Kind kind, std::string help, std::vector<Setting<ProcessCommand>> more = {}) {
  std::vector<Setting<ProcessCommand>> rows = {
      {.attribute = {"process", AttributeType::kText, true, "",
                     "name of the process or of its node; all processes of that name are meant", true},
       .place = place_of(&ProcessCommand::process)}};
  rows.insert(rows.end(), more.begin(), more.end());
  return action_of<ProcessCommand>({.tag = std::string(name_of(kind)), .help = std::move(help), .extension = true},
                                   std::move(rows),
                                   [kind](const Fields& fields, LaunchContext& context, ProcessCommand& command) {
                                     command.kind = kind;
                                     command.where = fields.text("process").where();
                                     context.requests().commands.push_back(std::move(command));
                                   });
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
