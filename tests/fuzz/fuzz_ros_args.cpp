// SPDX-License-Identifier: Apache-2.0
// The command line of a node: one argument per line of the input.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "rcl/arguments.h"
#include "rcl/error_handling.h"

namespace {

// Options that name files: with them the input would choose the files that are read.
bool names_a_file(const std::string& argument) {
  return argument.find("params-file") != std::string::npos || argument.find("log-config-file") != std::string::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> arguments = {"program", "--ros-args"};
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(text, line);) {
    if (names_a_file(line)) {
      return -1;
    }
    arguments.push_back(line);
  }
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(argument.c_str());
  }
  rcl_arguments_t parsed = rcl_get_zero_initialized_arguments();
  const rcl_ret_t result =
      rcl_parse_arguments(static_cast<int>(argv.size()), argv.data(), rcl_get_default_allocator(), &parsed);
  if (result == RCL_RET_OK && rcl_arguments_fini(&parsed) != RCL_RET_OK) {
    __builtin_trap();
  }
  rcl_reset_error();
  return 0;
}
