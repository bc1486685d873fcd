// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rclcpp/rclcpp.hpp>

#include "arm_driver/msg/effort.hpp"

namespace arm_driver {
msg::Effort hold(double load);
rclcpp::Node::SharedPtr make_arm(const rclcpp::NodeOptions& options);
}  // namespace arm_driver
