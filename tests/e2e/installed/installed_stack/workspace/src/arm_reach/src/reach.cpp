// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "arm_messages/msg/count.hpp"
#include "arm_messages/sum.hpp"
#include "rclcpp/rclcpp.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("reach");
  const auto publisher = node->create_publisher<arm_messages::msg::Count>("count", 1);
  arm_messages::msg::Reach reach;
  reach.lengths = {0.5, 0.25, 1.0};
  std::printf("%s %d %.2f of %d joints\n", publisher->get_topic_name(), reach.is_extended,
              arm_messages::sum(reach).meters, static_cast<int>(arm_messages::msg::Reach::JOINTS));
  rclcpp::shutdown();
}
