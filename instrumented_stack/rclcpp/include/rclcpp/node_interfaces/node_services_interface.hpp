// SPDX-License-Identifier: Apache-2.0
// The place where ROS 2 declares node_interfaces::NodeServicesInterface; here it is the class itself.
#pragma once

#include "rclcpp/node_interfaces/node_services.hpp"
