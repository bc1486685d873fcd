// SPDX-License-Identifier: Apache-2.0
// What a mistyped name was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

// The candidate with the fewest slips of the fingers between it and `name`: letters that are wrong, missing, too many
// or swapped with their neighbours; capitals do not count. "" when none is near enough to be meant. The first of
// several equally near ones.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace launch
