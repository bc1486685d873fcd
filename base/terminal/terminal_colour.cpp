// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal_colour.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <string_view>

namespace launch {
namespace {

std::string_view variable(const char* name) {
  const char* const value = ::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool shows_colour(int fd) {
  const std::string_view wish = variable("RCUTILS_COLORIZED_OUTPUT");
  if (wish == "0" || wish == "1") {
    return wish == "1";
  }
  return variable("NO_COLOR").empty() && ::isatty(fd) != 0;
}

}  // namespace launch
