// SPDX-License-Identifier: Apache-2.0
// What a mistyped name was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tracing {

// The candidate with the fewest changed letters; "" when none is near enough to be a typing error.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace tracing
