// SPDX-License-Identifier: Apache-2.0
#include "base/text/names.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/text/ascii.hpp"

namespace launch {

std::size_t edit_distance(std::string_view from, std::string_view to, std::size_t limit) {
  std::vector<std::size_t> before_last(to.size() + 1);
  std::vector<std::size_t> last(to.size() + 1);
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::size_t least = 0;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    const std::size_t least_of_last = std::exchange(least, i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min(std::min(last[j], row[j - 1]) + 1, replaced);
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
      least = std::min(least, row[j]);
    }
    // No number of a later row is less than the least of this row, or than the least of the last row plus one.
    if (least > limit && least_of_last >= limit) {
      return least;
    }
  }
  return row.back();
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  // A third of the name may differ: enough for a typing error, too little for an unrelated word.
  const std::size_t allowed = std::max<std::size_t>(1, name.size() / 3);
  const std::string wanted = lower(name);
  const std::string* nearest = nullptr;
  std::size_t nearest_distance = allowed + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t size_difference =
        candidate.size() > name.size() ? candidate.size() - name.size() : name.size() - candidate.size();
    if (size_difference >= nearest_distance || candidate == name) {
      continue;
    }
    const std::size_t distance = edit_distance(wanted, lower(candidate), nearest_distance - 1);
    // A candidate that shares no character with a short name is no suggestion.
    if (distance < nearest_distance && distance < std::max(name.size(), candidate.size())) {
      nearest = &candidate;
      nearest_distance = distance;
    }
  }
  return nearest == nullptr ? std::string() : *nearest;
}

}  // namespace launch
