// SPDX-License-Identifier: Apache-2.0
// The memory strategy that executors' options have by default.
#pragma once

#include "rclcpp/memory_strategy.hpp"

namespace rclcpp::memory_strategies {

// An AllocatorMemoryStrategy with the standard allocator.
memory_strategy::MemoryStrategy::SharedPtr create_default_strategy();

}  // namespace rclcpp::memory_strategies
