// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace launch {

// The first five names, and how many more there are: "a-1, b-2, c-3, d-4, e-5 and 3 more".
inline std::string list_some(const std::vector<std::string>& names) {
  constexpr std::size_t kListed = 5;
  const std::size_t listed = std::min(names.size(), kListed);
  std::string text;
  for (std::size_t i = 0; i < listed; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return listed < names.size() ? text + " and " + std::to_string(names.size() - listed) + " more" : text;
}

}  // namespace launch
