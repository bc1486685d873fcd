// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/executors/single_threaded_executor.hpp"

namespace rclcpp::executors {

[[gnu::hot]] void SingleThreadedExecutor::spin() {
  const SpinningScope scope(*this, "spin()");
  while (context_->is_valid() && spinning_) {
    AnyExecutable any_executable;
    if (get_next_executable(any_executable)) {
      execute_any_executable(any_executable);
    }
  }
}

}  // namespace rclcpp::executors
