// SPDX-License-Identifier: Apache-2.0
// Parameters of several nodes, as in parameter files.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "rclcpp/parameter.hpp"

namespace rclcpp {

// The keys are fully qualified names of nodes, or patterns with wildcards. Each has a leading slash.
using ParameterMap = std::unordered_map<std::string, std::vector<Parameter>>;

// With a fully qualified name, returns only the parameters that apply to that node, under its name. Throws
// exceptions::RCLError with `FILE:LINE: what is wrong`.
ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn = nullptr);

// With a fully qualified name, returns only the parameters of that node.
std::vector<Parameter> parameters_from_map(const ParameterMap& parameter_map, const char* node_fqn = nullptr);

}  // namespace rclcpp
