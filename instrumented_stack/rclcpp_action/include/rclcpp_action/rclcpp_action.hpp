// SPDX-License-Identifier: Apache-2.0
// All headers of rclcpp_action: servers and clients of actions.
//
//   auto server = rclcpp_action::create_server<Fibonacci>(node, "fibonacci", on_goal, on_cancel, on_accepted);
//   auto client = rclcpp_action::create_client<Fibonacci>(node, "fibonacci");
#pragma once

#include "rclcpp/node.hpp"
#include "rclcpp_action/client.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rclcpp_action/create_client.hpp"
#include "rclcpp_action/create_generic_client.hpp"
#include "rclcpp_action/create_server.hpp"
#include "rclcpp_action/exceptions.hpp"
#include "rclcpp_action/server.hpp"
#include "rclcpp_action/server_goal_handle.hpp"
#include "rclcpp_action/types.hpp"
