// SPDX-License-Identifier: Apache-2.0
// See rclcpp/visibility_control.hpp.
#pragma once

#define RCLCPP_LIFECYCLE_EXPORT __attribute__((visibility("default")))
#define RCLCPP_LIFECYCLE_IMPORT
#define RCLCPP_LIFECYCLE_PUBLIC __attribute__((visibility("default")))
#define RCLCPP_LIFECYCLE_PUBLIC_TYPE
#define RCLCPP_LIFECYCLE_LOCAL __attribute__((visibility("hidden")))
