// SPDX-License-Identifier: Apache-2.0
// Whether a type is one of others.
#pragma once

#include <type_traits>

namespace rclcpp::detail {

template <typename T, typename... OtherTs>
struct template_contains : std::bool_constant<(std::is_same_v<T, OtherTs> || ...)> {};

template <typename... Ts>
inline constexpr bool template_contains_v = template_contains<Ts...>::value;

}  // namespace rclcpp::detail
