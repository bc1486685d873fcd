// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/describe/schema_command.hpp"

#include "programs/launch/describe/schema.hpp"
#include "programs/launch/plan/dry_run_schema.hpp"
#include "programs/launch/result_output.hpp"
#include "programs/launch/subcommand.hpp"

namespace launch {

int schema_command(const std::vector<std::string>& words, const Registry& registry) {
  std::string format = "xsd";
  Subcommand command("launch schema",
                     "Prints a schema of the launch language, for editors: XSD for XML files, JSON Schema for YAML "
                     "files. dry-run: the "
                     "JSON Schema of what launch --dry-run=json prints.");
  command.take_choice("format", format, {"xsd", "json", "dry-run"}, "xsd, json or dry-run");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ResultOutput result("launch schema");
  result.print(format == "dry-run" ? std::string(dry_run_schema())
               : format == "xsd"   ? xml_schema(registry)
                                   : json_schema(registry));
  return result.finish() ? 0 : 1;
}

}  // namespace launch
