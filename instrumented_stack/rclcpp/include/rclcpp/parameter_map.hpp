// SPDX-License-Identifier: Apache-2.0
// Parameters of several nodes, as in parameter files.
#pragma once

#include <rcl_yaml_param_parser/parser.h>
#include <rcl_yaml_param_parser/types.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/parameter_value.hpp"

namespace rclcpp {

// The keys are fully qualified names of nodes, or patterns with wildcards. Each has a leading slash.
using ParameterMap = std::unordered_map<std::string, std::vector<Parameter>>;

// Converts structures of C. With a fully qualified name, returns only the parameters that apply to that node, under its
// name. Throws exceptions::InvalidParametersException if the structures have null pointers, and
// exceptions::InvalidParameterValueException if a parameter has no value, as one that is an empty list.
ParameterMap parameter_map_from(const rcl_params_t* c_params, const char* node_fqn = nullptr);

// Throws exceptions::InvalidParameterValueException if the pointer is null or no value is set.
ParameterValue parameter_value_from(const rcl_variant_t* c_value);

// Reads a file, and selects as parameter_map_from(), with its exceptions. Throws exceptions::RCLError with
// `FILE:LINE: what is wrong`.
ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn = nullptr);

// With a fully qualified name, returns only the parameters of that node.
std::vector<Parameter> parameters_from_map(const ParameterMap& parameter_map, const char* node_fqn = nullptr);

}  // namespace rclcpp
