// SPDX-License-Identifier: Apache-2.0
// Parameters of several nodes, as parameter files hold them.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "rclcpp/parameter.hpp"

namespace rclcpp {

// By the fully qualified name of a node, or a pattern with wildcards, each with a leading slash.
using ParameterMap = std::unordered_map<std::string, std::vector<Parameter>>;

// With a fully qualified name: what the file holds for that node, under its name. Throws exceptions::RCLError with
// `FILE:LINE: what is wrong`.
ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn = nullptr);

// With a fully qualified name: those of that node.
std::vector<Parameter> parameters_from_map(const ParameterMap& parameter_map, const char* node_fqn = nullptr);

}  // namespace rclcpp
