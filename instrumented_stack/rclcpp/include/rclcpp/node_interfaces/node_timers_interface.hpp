// SPDX-License-Identifier: Apache-2.0
// ROS 2 declares node_interfaces::NodeTimersInterface here. In this stack it is the class itself.
#pragma once

#include "rclcpp/node_interfaces/node_timers.hpp"
