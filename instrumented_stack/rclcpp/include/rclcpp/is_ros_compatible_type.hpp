// SPDX-License-Identifier: Apache-2.0
// Whether a type can be published: a message, or a type with a TypeAdapter.
#pragma once

#include <rosidl_runtime_cpp/traits.hpp>

#include "rclcpp/type_adapter.hpp"

namespace rclcpp {

template <typename T>
struct is_ros_compatible_type {
  static constexpr bool value = rosidl_generator_traits::is_message<T>::value || TypeAdapter<T>::is_specialized::value;
};

}  // namespace rclcpp
