// SPDX-License-Identifier: Apache-2.0
// Many values as one string.
#pragma once

#include <sstream>
#include <string>

namespace rcpputils {

// The elements as operator<< writes them, `delim` between them.
template <typename CharT, typename ContainerT>
std::basic_string<CharT> join(const ContainerT& container, const CharT* delim) {
  std::basic_ostringstream<CharT> joined;
  bool first = true;
  for (const auto& element : container) {
    if (!first) {
      joined << delim;
    }
    first = false;
    joined << element;
  }
  return joined.str();
}

}  // namespace rcpputils
