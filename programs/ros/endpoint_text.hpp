// SPDX-License-Identifier: Apache-2.0
// How the commands print what the graph knows of the ends of topics and services.
#pragma once

#include <rclcpp/rclcpp.hpp>
#include <string>

namespace launch {

// "01.0f.…"
std::string gid_text(const rclcpp::TopicEndpointInfo& endpoint);
// A line for each policy, without an end of the last one. Each line begins with `indent`.
std::string qos_text(const rclcpp::TopicEndpointInfo& endpoint, const std::string& indent);

}  // namespace launch
