// SPDX-License-Identifier: Apache-2.0
// Kept for programs written for it: every executor here rebuilds its list of entities only after a change, which is
// what this one was made for.
#pragma once

#include "rclcpp/executors/single_threaded_executor.hpp"

namespace rclcpp::executors {

class StaticSingleThreadedExecutor : public SingleThreadedExecutor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(StaticSingleThreadedExecutor)

  explicit StaticSingleThreadedExecutor(const ExecutorOptions& options = ExecutorOptions())
      : SingleThreadedExecutor(options) {}
};

}  // namespace rclcpp::executors
