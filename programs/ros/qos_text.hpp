// SPDX-License-Identifier: Apache-2.0
// Describes a publisher or subscription as `ros2 topic info --verbose` does.
#pragma once

#include <rclcpp/topic_endpoint_info.hpp>
#include <string>

namespace launch {

// Several lines, without an end of the last one.
std::string endpoint_text(const rclcpp::TopicEndpointInfo& endpoint);

}  // namespace launch
