// SPDX-License-Identifier: Apache-2.0
// What a misspelt name may have meant.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace rclcpp_components {

// The number of letters to insert, leave out or replace.
inline std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// "; did you mean 'exec'?" for the name that is nearest to `name`, or "" if none is near enough.
template <typename NamesT>
std::string did_you_mean(std::string_view name, const NamesT& names) {
  std::string_view nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : names) {
    if (const std::size_t away = distance(name, candidate); away < least) {
      least = away;
      nearest = candidate;
    }
  }
  return least <= std::max<std::size_t>(2, name.size() / 3) ? "; did you mean '" + std::string(nearest) + "'?" : "";
}

}  // namespace rclcpp_components
