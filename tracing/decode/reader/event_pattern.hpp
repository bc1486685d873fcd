// SPDX-License-Identifier: Apache-2.0
// Patterns of names, such as `ros2:callback_*`.
#pragma once

#include <string_view>

namespace tracing {

// `*` stands for any characters, `?` for one.
bool matches_pattern(std::string_view pattern, std::string_view text);

}  // namespace tracing
