// SPDX-License-Identifier: Apache-2.0
// Whether a class has the functions on_activate() and on_deactivate() of an entity that a managed node switches.
#pragma once

#include <type_traits>
#include <utility>

template <class T, typename = void>
struct has_on_activate {
  static constexpr bool value = false;
};
template <class T>
struct has_on_activate<T, std::enable_if_t<std::is_same_v<void, decltype(std::declval<T>().on_activate())>>> {
  static constexpr bool value = true;
};

template <class T, typename = void>
struct has_on_deactivate {
  static constexpr bool value = false;
};
template <class T>
struct has_on_deactivate<T, std::enable_if_t<std::is_same_v<void, decltype(std::declval<T>().on_deactivate())>>> {
  static constexpr bool value = true;
};

template <class T>
struct is_manageable_node : std::bool_constant<has_on_activate<T>::value && has_on_deactivate<T>::value> {};
