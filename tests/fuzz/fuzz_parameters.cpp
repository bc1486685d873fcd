// SPDX-License-Identifier: Apache-2.0
// The text of a parameter file, and of a value on the command line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "rcl/parameter_overrides.hpp"

// A node refuses an empty list, which has no type.
void give_to_node(const rcl::ParameterOverrides& overrides) {
  try {
    (void)overrides.for_node("/fuzz/node");
  } catch (const std::invalid_argument&) {
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rcl::ParameterOverrides file;
  try {
    file.load_text(text, "parameters.yaml");
    give_to_node(file);
    rcl::ParameterOverrides again;
    again.load_text(text, "parameters.yaml");
    if (again.patterns().size() != file.patterns().size()) {
      std::abort();  // the same text must mean the same
    }
  } catch (const std::invalid_argument&) {
    if (!file.empty()) {
      std::abort();  // a file is valid as a whole or has no effect
    }
  }
  rcl::ParameterOverrides value;
  try {
    value.set_from_text("/**", "name", text);
    give_to_node(value);
  } catch (const std::invalid_argument&) {
    if (!value.empty()) {
      std::abort();
    }
  }
  return 0;
}
