// SPDX-License-Identifier: Apache-2.0
// <executable cmd="…"/>: runs any program.
#include "actions/process/process_fields.hpp"

namespace launch {

namespace {

class ExecuteProcess : public Action {
 public:
  explicit ExecuteProcess(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        command_(fields.words("cmd")),
        command_where_(fields.where("cmd")),
        name_(fields.optional_text("name")),
        process_(fields) {}

 protected:
  void execute(LaunchContext& context) const override {
    ProcessSpec spec;
    for (const Template& word : command_) {
      spec.argv.push_back(word.perform(context.scope()));
    }
    if (spec.argv.empty() || spec.argv.front().empty()) {
      throw LaunchError("the command is empty", command_where_);
    }
    if (name_) {
      spec.name = name_->perform(context.scope());
    }
    process_.request(context, std::move(spec));
  }

 private:
  std::vector<Template> command_;
  SourceRange command_where_;
  std::optional<Template> name_;
  ProcessFields process_;
};

}  // namespace

ActionType executable_action() {
  std::vector<AttributeSpec> attributes = {
      {"cmd", AttributeType::kCommandLine, true, "", "the command line; split into words, not run by a shell"},
      {"name", AttributeType::kText, false, "base name of the program", "label of the process"}};
  const std::vector<AttributeSpec> common = ProcessFields::attributes();
  attributes.insert(attributes.end(), common.begin(), common.end());
  return {
      .tag = "executable",
      .help = "Runs a program.",
      .attributes = std::move(attributes),
      .items = ProcessFields::items(),
      .make = [](const Fields& fields) { return std::make_shared<ExecuteProcess>(fields); },
  };
}

}  // namespace launch
