// SPDX-License-Identifier: Apache-2.0
#include "their_rclcpp.hpp"

int main(int argc, char** argv) {
  return spin_their_node(argc, argv);
}
