// SPDX-License-Identifier: Apache-2.0
// See rclcpp/visibility_control.hpp.
#pragma once

#define RCLCPP_COMPONENTS_EXPORT __attribute__((visibility("default")))
#define RCLCPP_COMPONENTS_IMPORT
#define RCLCPP_COMPONENTS_PUBLIC __attribute__((visibility("default")))
#define RCLCPP_COMPONENTS_PUBLIC_TYPE
#define RCLCPP_COMPONENTS_LOCAL __attribute__((visibility("hidden")))
