// SPDX-License-Identifier: Apache-2.0
// The options for creating an executor.
#pragma once

#include <cstddef>

#include "rclcpp/contexts/default_context.hpp"

namespace rclcpp {

struct ExecutorOptions {
  Context::SharedPtr context = contexts::get_global_default_context();
  size_t max_conditions = 0;  // part of rclcpp's interface; wait sets here grow as needed
};

}  // namespace rclcpp
