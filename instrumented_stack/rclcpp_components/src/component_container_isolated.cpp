// SPDX-License-Identifier: Apache-2.0
// A process for components. Each has its own executor and thread.
//
// Option: --use_multi_threaded_executor  each has several threads
#include <algorithm>

#include "container_main.hpp"
#include "rclcpp_components/component_manager_isolated.hpp"

namespace {

template <typename ExecutorT>
void run() {
  const auto executor = std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
  const auto manager = std::make_shared<rclcpp_components::ComponentManagerIsolated<ExecutorT>>(executor);
  executor->add_node(manager);
  executor->spin();
}

}  // namespace

int main(int argc, char** argv) {
  return rclcpp_components::container_main(
      "component_container_isolated", argc, argv, [](const std::vector<std::string>& arguments) {
        if (std::find(arguments.begin(), arguments.end(), "--use_multi_threaded_executor") != arguments.end()) {
          run<rclcpp::executors::MultiThreadedExecutor>();
        } else {
          run<rclcpp::executors::SingleThreadedExecutor>();
        }
      });
}
