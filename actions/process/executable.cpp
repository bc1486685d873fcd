// SPDX-License-Identifier: Apache-2.0
// <executable cmd="…"/>: runs any program.
#include "actions/process/process_settings.hpp"

namespace launch {

namespace {

class ExecuteProcess : public Action {
 public:
  explicit ExecuteProcess(const Fields& fields) : Action(fields.where(), fields.condition()), fields_(fields) {
    check_process(fields_);
  }

 protected:
  void execute(LaunchContext& context) const override {
    ProcessSpec spec;
    for (const Template& word : fields_.words("cmd")) {
      spec.argv.push_back(word.perform(context.scope()));
    }
    if (spec.argv.empty() || spec.argv.front().empty()) {
      throw LaunchError("the command is empty", fields_.where("cmd"));
    }
    if (fields_.has("name")) {
      spec.name = fields_.text("name").perform(context.scope());
    }
    request_process(fields_, context, std::move(spec));
  }

 private:
  Fields fields_;
};

}  // namespace

ActionType executable_action() {
  return {
      .tag = "executable",
      .help = "Runs a program.",
      .attributes = with_process_attributes(
          {{"cmd", AttributeType::kCommandLine, true, "", "the command line; split into words, not run by a shell"},
           {"name", AttributeType::kText, false, "base name of the program", "label of the process"}}),
      .items = process_items(),
      .make = [](const Fields& fields) { return std::make_shared<ExecuteProcess>(fields); },
  };
}

}  // namespace launch
