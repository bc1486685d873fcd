// SPDX-License-Identifier: Apache-2.0
// Splits a string into several.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace rcpputils {

// The parts between the delimiters. An empty string has no parts, and a delimiter at the end starts no empty part.
// `skip_empty` leaves out empty parts.
template <class InsertIterator>
void split(const std::string& input, char delim, InsertIterator& it, bool skip_empty = false) {
  std::istringstream stream(input);
  std::string part;
  while (std::getline(stream, part, delim)) {
    if (!skip_empty || !part.empty()) {
      it = part;
    }
  }
}

inline std::vector<std::string> split(const std::string& input, char delim, bool skip_empty = false) {
  std::vector<std::string> parts;
  auto inserter = std::back_inserter(parts);
  split(input, delim, inserter, skip_empty);
  return parts;
}

}  // namespace rcpputils
