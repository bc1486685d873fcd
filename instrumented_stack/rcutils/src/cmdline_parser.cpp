// SPDX-License-Identifier: Apache-2.0
#include "rcutils/cmdline_parser.h"

#include <algorithm>
#include <string_view>

bool rcutils_cli_option_exist(char** begin, char** end, const char* option) {
  return std::find(begin, end, std::string_view(option)) != end;
}

char* rcutils_cli_get_option(char** begin, char** end, const char* option) {
  char** const found = std::find(begin, end, std::string_view(option));
  return found != end && found + 1 != end ? found[1] : nullptr;
}
