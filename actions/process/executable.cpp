// SPDX-License-Identifier: Apache-2.0
// <executable cmd="…"/>: runs any program.
#include <filesystem>

#include "actions/parameters/parameter_file.hpp"
#include "actions/process/machine_settings.hpp"
#include "actions/process/process_settings.hpp"
#include "actions/row_action.hpp"
#include "actions/values/quirks.hpp"
#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

void request_command(const Fields& fields, LaunchContext& context) {
  const auto describe = [&](Scope& scope) {
    const std::vector<Template> words = fields.words("cmd");
    std::string name = fields.has("name") ? fields.text("name").perform(scope)
                       : words.empty()    ? std::string()
                                          : std::filesystem::path(words.front().perform(scope)).filename().string();
    return AssignableProcess{"", pushed_namespace(scope).value_or("/"), {std::move(name)}};
  };
  const AtMachine there(context, machine_of_process(fields, context, describe));
  Scope& scope = context.scope();
  ProcessSpec spec;
  for (const Template& word : fields.words("cmd")) {
    spec.argv.push_back(word.perform(scope));
  }
  if (spec.argv.empty() || spec.argv.front().empty()) {
    throw LaunchError("the command is empty", fields.where("cmd"));
  }
  if (fields.has("name")) {
    spec.name = fields.text("name").perform(scope);
  }
  if (!fields.boolean("shell", false).perform(scope)) {
    find_variables_with_blanks(fields.words("cmd"), context);
  }
  find_faults_of_named_files(spec.argv, 1, spec.argv.size(), fields.where("cmd"), context);
  request_process(fields, context, std::move(spec));
}

}  // namespace

ActionType executable_action() {
  return action_of<NoValues>(
      {.tag = "executable",
       .help = "Runs a program.",
       .attributes = with_process_attributes({}),
       .items = process_items()},
      {{.attribute = {"cmd", AttributeType::kCommandLine, true, "",
                      "the command line; split into words, not run by a shell"}},
       {.attribute = {"name", AttributeType::kText, false, "base name of the program", "label of the process"}},
       {.attribute = machine_attribute("the machine on which the process runs; local: this one")}},
      [](const Fields& fields, LaunchContext& context, NoValues&) { request_command(fields, context); }, check_process);
}

}  // namespace launch
