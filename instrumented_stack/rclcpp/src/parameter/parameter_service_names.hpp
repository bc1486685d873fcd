// SPDX-License-Identifier: Apache-2.0
// Names of the parameter services, below the name of their node.
#pragma once

#include <string>

namespace rclcpp::parameter_service_names {

inline constexpr const char* kGetParameters = "get_parameters";
inline constexpr const char* kGetParameterTypes = "get_parameter_types";
inline constexpr const char* kSetParameters = "set_parameters";
inline constexpr const char* kSetParametersAtomically = "set_parameters_atomically";
inline constexpr const char* kDescribeParameters = "describe_parameters";
inline constexpr const char* kListParameters = "list_parameters";

// `talker/get_parameters`
inline std::string of(const std::string& node_name, const char* service) {
  return node_name + "/" + service;
}

}  // namespace rclcpp::parameter_service_names
