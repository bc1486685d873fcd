// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace launch {

// At blanks.
inline std::vector<std::string> words_of_text(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()};
}

}  // namespace launch
