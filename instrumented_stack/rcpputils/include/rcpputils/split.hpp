// SPDX-License-Identifier: Apache-2.0
// One string as several.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace rcpputils {

// The parts between the delimiters; none for an empty string, and no empty one after a delimiter at the end.
// `skip_empty` leaves out the empty ones.
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
