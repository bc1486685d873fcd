// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/schema_command.hpp"

#include <fmt/format.h>

#include "launcher/cli/schema.hpp"
#include "launcher/cli/subcommand.hpp"

namespace launch {

int schema_command(const std::vector<std::string>& words, const Registry& registry) {
  std::string format = "xsd";
  Subcommand command(
      "launch schema",
      "Prints a schema of the launch language, for editors: XSD for XML files, JSON Schema for YAML files.");
  command.take_choice("format", format, {"xsd", "json"}, "xsd or json");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  fmt::print("{}", format == "xsd" ? xml_schema(registry) : json_schema(registry));
  return 0;
}

}  // namespace launch
