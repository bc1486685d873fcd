// SPDX-License-Identifier: Apache-2.0
// Prints the messages of topic chatter: the component of demo_nodes_cpp.
#include "rclcpp_components/single_threaded_node_main.hpp"

int main(int argc, char** argv) {
  return rclcpp_components::single_threaded_node_main("demo_nodes_cpp::Listener", argc, argv);
}
