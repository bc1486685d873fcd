// SPDX-License-Identifier: Apache-2.0
// A component of demo_nodes_cpp as a program of demo_nodes. CMakeLists.txt defines COMPONENT, its class.
#include "rclcpp_components/single_threaded_node_main.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::single_threaded_node_main("demo_nodes_cpp::" COMPONENT, argc, argv);
}
