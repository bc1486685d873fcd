// SPDX-License-Identifier: Apache-2.0
// The options for creating an executor.
#pragma once

#include <cstddef>

#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/memory_strategies.hpp"
#include "rclcpp/memory_strategy.hpp"

namespace rclcpp {

struct ExecutorOptions {
  // Part of rclcpp's interface; executors do not use it.
  memory_strategy::MemoryStrategy::SharedPtr memory_strategy = memory_strategies::create_default_strategy();
  Context::SharedPtr context = contexts::get_global_default_context();
  size_t max_conditions = 0;  // part of rclcpp's interface; wait sets here grow as needed
};

}  // namespace rclcpp
