// SPDX-License-Identifier: Apache-2.0
// The place where ROS 2 declares node_interfaces::NodeBaseInterface; here it is the class itself.
#pragma once

#include "rclcpp/node_interfaces/node_base.hpp"
