// SPDX-License-Identifier: Apache-2.0
// Joins many values into one string.
#pragma once

#include <sstream>
#include <string>

namespace rcpputils {

// The elements, written with operator<< and separated by `delim`.
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
