// SPDX-License-Identifier: Apache-2.0
#include "track_navigator/navigator.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<track_navigator::Navigator>();
  rclcpp::spin(node->get_node_base_interface());
  rclcpp::shutdown();
}
