// SPDX-License-Identifier: Apache-2.0
// Replacing in strings.
#pragma once

#include <string>

namespace rcpputils {

// `input` with every `find` replaced; unchanged if `find` is empty.
inline std::string find_and_replace(const std::string& input, const std::string& find, const std::string& replace) {
  std::string output = input;
  if (find.empty()) {
    return output;
  }
  for (size_t at = output.find(find); at != std::string::npos; at = output.find(find, at + replace.size())) {
    output.replace(at, find.size(), replace);
  }
  return output;
}

}  // namespace rcpputils
