// SPDX-License-Identifier: Apache-2.0
#include "base/environment/own_environment.hpp"

#include <unistd.h>

#include <string_view>

namespace launch {

Environment own_environment() {
  Environment::Variables variables;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    const std::size_t separator = text.find('=');
    if (separator != std::string_view::npos) {
      variables.emplace(text.substr(0, separator), text.substr(separator + 1));
    }
  }
  return variables;
}

}  // namespace launch
