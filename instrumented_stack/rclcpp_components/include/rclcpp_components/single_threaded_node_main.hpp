// SPDX-License-Identifier: Apache-2.0
// The program of one component with the default executor. It is compiled once, in the library.
#pragma once

namespace rclcpp_components {

// node_main() of node_main.hpp with rclcpp::executors::SingleThreadedExecutor.
int single_threaded_node_main(const char* class_name, int argc, char** argv);

}  // namespace rclcpp_components
