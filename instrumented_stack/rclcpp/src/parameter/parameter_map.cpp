// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_map.hpp"

#include <rcl/error_handling.h>

#include <rcl/parameter_overrides.hpp>
#include <stdexcept>
#include <variant>

#include "rclcpp/exceptions.hpp"

namespace rclcpp {

ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn) {
  rcl::ParameterOverrides file;
  try {
    file.load_file(yaml_filename);
  } catch (const std::invalid_argument& error) {
    RCL_SET_ERROR_MSG(error.what());
    exceptions::throw_from_rcl_error(RCL_RET_ERROR);
  }
  ParameterMap map;
  for (const auto& [pattern, values] : file.patterns()) {
    if (node_fqn != nullptr && !rcl::node_pattern_matches(pattern, node_fqn)) {
      continue;
    }
    std::vector<Parameter>& parameters = map[node_fqn != nullptr ? node_fqn : pattern];
    for (const auto& [name, value] : values) {
      parameters.push_back(std::visit([&name = name](const auto& typed) { return Parameter(name, typed); }, value));
    }
  }
  return map;
}

std::vector<Parameter> parameters_from_map(const ParameterMap& parameter_map, const char* node_fqn) {
  std::vector<Parameter> parameters;
  for (const auto& [pattern, of_node] : parameter_map) {
    if (node_fqn == nullptr || rcl::node_pattern_matches(pattern, node_fqn)) {
      parameters.insert(parameters.end(), of_node.begin(), of_node.end());
    }
  }
  return parameters;
}

}  // namespace rclcpp
