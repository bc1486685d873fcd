// SPDX-License-Identifier: Apache-2.0
// The text of a parameter file, and of a value on the command line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "rcl/parameter_overrides.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  rcl::ParameterOverrides file;
  try {
    file.load_text(text, "parameters.yaml");
    (void)file.for_node("/fuzz/node");
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
    (void)value.for_node("/fuzz/node");
  } catch (const std::invalid_argument&) {
    if (!value.empty()) {
      std::abort();
    }
  }
  return 0;
}
