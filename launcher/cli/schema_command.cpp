// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/schema_command.hpp"

#include <fmt/format.h>

#include "launcher/cli/dry_run_schema.hpp"
#include "launcher/cli/schema.hpp"
#include "launcher/cli/subcommand.hpp"

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
  if (format == "dry-run") {
    fmt::print("{}", dry_run_schema());
    return 0;
  }
  fmt::print("{}", format == "xsd" ? xml_schema(registry) : json_schema(registry));
  return 0;
}

}  // namespace launch
