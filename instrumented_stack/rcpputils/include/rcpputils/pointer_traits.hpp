// SPDX-License-Identifier: Apache-2.0
// Whether a type is a raw or smart pointer, and what it points to.
#pragma once

#include <memory>
#include <type_traits>

namespace rcpputils {

template <typename T>
struct is_pointer : std::is_pointer<T> {};
template <typename T>
struct is_pointer<T&> : is_pointer<T> {};
template <typename T>
struct is_pointer<const T> : is_pointer<T> {};
template <typename T>
struct is_pointer<std::shared_ptr<T>> : std::true_type {};
template <typename T, typename DeleterT>
struct is_pointer<std::unique_ptr<T, DeleterT>> : std::true_type {};

template <typename T>
struct remove_pointer : std::remove_pointer<T> {};
template <typename T>
struct remove_pointer<T&> : remove_pointer<T> {};
template <typename T>
struct remove_pointer<const T> : remove_pointer<T> {};
template <typename T>
struct remove_pointer<std::shared_ptr<T>> {
  using type = T;
};
template <typename T, typename DeleterT>
struct remove_pointer<std::unique_ptr<T, DeleterT>> {
  using type = T;
};

}  // namespace rcpputils
