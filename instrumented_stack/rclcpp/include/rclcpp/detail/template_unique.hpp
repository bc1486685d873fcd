// SPDX-License-Identifier: Apache-2.0
// Whether no type of a list is in it twice.
#pragma once

#include <type_traits>

#include "rclcpp/detail/template_contains.hpp"

namespace rclcpp::detail {

template <typename... Ts>
struct template_unique : std::true_type {};
template <typename T, typename... OtherTs>
struct template_unique<T, OtherTs...>
    : std::bool_constant<!template_contains_v<T, OtherTs...> && template_unique<OtherTs...>::value> {};

template <typename... Ts>
inline constexpr bool template_unique_v = template_unique<Ts...>::value;

}  // namespace rclcpp::detail
