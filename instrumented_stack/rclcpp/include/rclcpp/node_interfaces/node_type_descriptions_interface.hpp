// SPDX-License-Identifier: Apache-2.0
// The place where ROS 2 declares node_interfaces::NodeTypeDescriptionsInterface; here it is the class itself.
#pragma once

#include "rclcpp/node_interfaces/node_type_descriptions.hpp"
