// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_components/single_threaded_node_main.hpp"

#include "rclcpp_components/node_main.hpp"

namespace rclcpp_components {

int single_threaded_node_main(const char* class_name, int argc, char** argv) {
  return node_main<rclcpp::executors::SingleThreadedExecutor>(class_name, argc, argv);
}

}  // namespace rclcpp_components
