// SPDX-License-Identifier: Apache-2.0
// <executable cmd="…"/>: runs any program.
#include "actions/parameters/parameter_file.hpp"
#include "actions/process/process_settings.hpp"
#include "actions/row_action.hpp"
#include "actions/values/quirks.hpp"

namespace launch {

namespace {

void perform_command(const Fields& fields, Scope& scope, ProcessSpec& spec) {
  for (const Template& word : fields.words("cmd")) {
    spec.argv.push_back(word.perform(scope));
  }
  if (spec.argv.empty() || spec.argv.front().empty()) {
    throw LaunchError("the command is empty", fields.where("cmd"));
  }
}

}  // namespace

ActionType executable_action() {
  return action_of<ProcessSpec>(
      {.tag = "executable",
       .help = "Runs a program.",
       .attributes = with_process_attributes({}),
       .items = process_items()},
      {{.attribute = {"cmd", AttributeType::kCommandLine, true, "",
                      "the command line; split into words, not run by a shell"},
        .perform = perform_command},
       {.attribute = {"name", AttributeType::kText, false, "base name of the program", "label of the process"},
        .place = place_of(&ProcessSpec::name)}},
      [](const Fields& fields, LaunchContext& context, ProcessSpec& spec) {
        if (!fields.boolean("shell", false).perform(context.scope())) {
          find_variables_with_blanks(fields.words("cmd"), context);
        }
        find_faults_of_named_files(spec.argv, 1, spec.argv.size(), fields.where("cmd"), context);
        request_process(fields, context, std::move(spec));
      },
      check_process);
}

}  // namespace launch
