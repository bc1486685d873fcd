// SPDX-License-Identifier: Apache-2.0
// `launch schema` and `launch reference`: descriptions of the launch language, for editors and for people.
#include "actions/builtin_actions.hpp"
#include "launcher/plan/dry_run.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/describe/descriptions.hpp"

namespace launch {

Words schema_words(const Words& /*words*/) {
  return {"dry-run", "json", "xsd"};
}

int reference_command(const Words& words) {
  Subcommand command("launch reference", "Prints the reference of the launch language as Markdown.");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ResultOutput result("launch reference");
  result.print(reference_page(builtin_actions()));
  return result.finish() ? 0 : 1;
}

int schema_command(const std::vector<std::string>& words) {
  std::string format = "xsd";
  Subcommand command("launch schema",
                     "Prints a schema of the launch language, for editors: XSD for XML files, JSON Schema for YAML "
                     "files. dry-run: the "
                     "JSON Schema of what launch --dry-run=json prints.");
  command.take_choice("format", format, {"xsd", "json", "dry-run"}, "xsd, json or dry-run");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  const Registry registry = builtin_actions();
  ResultOutput result("launch schema");
  result.print(format == "dry-run" ? std::string(dry_run_schema())
               : format == "xsd"   ? xml_schema(registry)
                                   : json_schema(registry));
  return result.finish() ? 0 : 1;
}

}  // namespace launch
