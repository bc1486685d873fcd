// SPDX-License-Identifier: Apache-2.0
// Exists for programs that use it. It was made to rebuild the list of entities only after a change; every executor here
// does that.
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
