// SPDX-License-Identifier: Apache-2.0
// See rclcpp/visibility_control.hpp.
#pragma once

#define RCLCPP_ACTION_EXPORT __attribute__((visibility("default")))
#define RCLCPP_ACTION_IMPORT
#define RCLCPP_ACTION_PUBLIC __attribute__((visibility("default")))
#define RCLCPP_ACTION_PUBLIC_TYPE
#define RCLCPP_ACTION_LOCAL __attribute__((visibility("hidden")))
