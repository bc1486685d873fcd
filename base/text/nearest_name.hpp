// SPDX-License-Identifier: Apache-2.0
// Finds the name that a user probably meant by a mistyped one.
#pragma once

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

}  // namespace launch
