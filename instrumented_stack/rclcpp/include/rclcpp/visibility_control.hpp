// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible. The macros exist for
// applications that use them.
#pragma once

#define RCLCPP_EXPORT __attribute__((visibility("default")))
#define RCLCPP_IMPORT
#define RCLCPP_PUBLIC __attribute__((visibility("default")))
#define RCLCPP_PUBLIC_TYPE
#define RCLCPP_LOCAL __attribute__((visibility("hidden")))
