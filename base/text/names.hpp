// SPDX-License-Identifier: Apache-2.0
// Names: the one that a mistyped one probably means, a list of some, and those in remap rules.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

// Number of insertions, deletions, replacements and swaps of neighbours that lead from `from` to `to` (restricted
// Damerau-Levenshtein distance). If it is more than `limit`, any number above `limit`.
std::size_t edit_distance(std::string_view from, std::string_view to, std::size_t limit = std::string_view::npos);

// The candidate with the fewest typing errors between it and `name`: letters that are wrong, missing, too many or
// swapped with their neighbours. Capitals do not count. When several are equally near, the first one is returned. ""
// when none is near enough.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

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

// The name without "rostopic://" or "rosservice://", which tell what a rule is for.
inline std::string_view without_scheme(std::string_view name) {
  for (const std::string_view scheme : {"rostopic://", "rosservice://"}) {
    if (name.starts_with(scheme)) {
      name.remove_prefix(scheme.size());
    }
  }
  return name;
}

}  // namespace launch
