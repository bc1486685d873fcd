// SPDX-License-Identifier: Apache-2.0
// <stop>, <restart>, <signal>: end, start again or signal a running process.

#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class CommandProcess : public Action {
 public:
  CommandProcess(const Fields& fields, ProcessCommand::Kind kind)
      : Action(fields.where(), fields.condition()), kind_(kind), process_(fields.text("process")) {
    if (kind == ProcessCommand::Kind::kSignal) {
      signal_ = fields.text("signal");
      if (signal_->is_literal()) {
        Scope nothing;
        signal_of(signal_->perform(nothing), signal_->where());
      }
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    context.requests().commands.push_back({.kind = kind_,
                                           .process = process_.perform(scope),
                                           .signal = signal_ ? signal_of(signal_->perform(scope), signal_->where()) : 0,
                                           .where = process_.where()});
  }

 private:
  ProcessCommand::Kind kind_;
  Template process_;
  std::optional<Template> signal_;
};

ActionType command(ProcessCommand::Kind kind, std::string help, std::vector<AttributeSpec> more = {}) {
  std::vector<AttributeSpec> attributes = {{"process", AttributeType::kText, true, "",
                                            "name of the process or of its node; all processes of that name are meant",
                                            true}};
  attributes.insert(attributes.end(), more.begin(), more.end());
  return {.tag = std::string(name_of(kind)),
          .help = std::move(help),
          .attributes = std::move(attributes),
          .items = {},
          .extension = true,
          .make = [kind](const Fields& fields) { return std::make_shared<CommandProcess>(fields, kind); }};
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
  return command(ProcessCommand::Kind::kSignal, "Sends a signal to a running process and its descendants.",
                 {{"signal", AttributeType::kText, true, "", "its name or its number, such as SIGUSR1", true}});
}

}  // namespace launch
