// SPDX-License-Identifier: Apache-2.0
// Finds the name that a user probably meant by a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

// The candidate with the fewest typing errors between it and `name`: letters that are wrong, missing, too many or
// swapped with their neighbours. Capitals do not count. When several are equally near, the first one is returned. ""
// when none is near enough.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace launch
