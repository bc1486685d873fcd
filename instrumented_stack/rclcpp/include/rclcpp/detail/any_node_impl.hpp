// SPDX-License-Identifier: Apache-2.0
// The templates of any_node.hpp.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/detail/any_node.hpp"

namespace rclcpp::detail {

template <typename ParameterT>
auto AnyNode::declare_parameter(const std::string& name, const ParameterT& default_value,
                                const rcl_interfaces::msg::ParameterDescriptor& descriptor, bool ignore_override) {
  try {
    return declare_parameter(name, ParameterValue(default_value), descriptor, ignore_override).get<ParameterT>();
  } catch (const ParameterTypeException& error) {
    throw exceptions::InvalidParameterTypeException(name, error.what());
  }
}

template <typename ParameterT>
auto AnyNode::declare_parameter(const std::string& name, const rcl_interfaces::msg::ParameterDescriptor& descriptor,
                                bool ignore_override) {
  const ParameterType type = ParameterValue(ParameterT{}).get_type();
  try {
    return declare_parameter(name, type, descriptor, ignore_override).get<ParameterT>();
  } catch (const ParameterTypeException&) {
    throw exceptions::UninitializedStaticallyTypedParameterException(name);
  }
}

template <typename ParameterT>
std::vector<ParameterT> AnyNode::declare_parameters(const std::string& parameter_namespace,
                                                    const std::map<std::string, ParameterT>& parameters,
                                                    bool ignore_overrides) {
  const std::string prefix = parameter_namespace.empty() ? parameter_namespace : parameter_namespace + ".";
  std::vector<ParameterT> values;
  for (const auto& [name, default_value] : parameters) {
    values.push_back(
        declare_parameter(prefix + name, default_value, rcl_interfaces::msg::ParameterDescriptor(), ignore_overrides));
  }
  return values;
}

template <typename ParameterT>
std::vector<ParameterT> AnyNode::declare_parameters(
    const std::string& parameter_namespace,
    const std::map<std::string, std::pair<ParameterT, rcl_interfaces::msg::ParameterDescriptor>>& parameters,
    bool ignore_overrides) {
  const std::string prefix = parameter_namespace.empty() ? parameter_namespace : parameter_namespace + ".";
  std::vector<ParameterT> values;
  for (const auto& [name, default_and_descriptor] : parameters) {
    const auto& [default_value, descriptor] = default_and_descriptor;
    values.push_back(declare_parameter(prefix + name, default_value, descriptor, ignore_overrides));
  }
  return values;
}

template <typename ParameterT>
bool AnyNode::get_parameter(const std::string& name, ParameterT& parameter) const {
  Parameter found;
  if (!get_parameter(name, found)) {
    return false;
  }
  parameter = found.get_value<ParameterT>();
  return true;
}

template <typename ParameterT>
bool AnyNode::get_parameters(const std::string& prefix, std::map<std::string, ParameterT>& values) const {
  std::map<std::string, Parameter> found;
  if (!node_parameters_->get_parameters_by_prefix(prefix, found)) {
    return false;
  }
  for (const auto& [name, parameter] : found) {
    values[name] = parameter.template get_value<ParameterT>();
  }
  return true;
}

template <typename ParameterT>
bool AnyNode::get_parameter_or(const std::string& name, ParameterT& parameter,
                               const ParameterT& alternative_value) const {
  if (get_parameter(name, parameter)) {
    return true;
  }
  parameter = alternative_value;
  return false;
}

template <typename ParameterT>
ParameterT AnyNode::get_parameter_or(const std::string& name, const ParameterT& alternative_value) const {
  ParameterT parameter;
  get_parameter_or(name, parameter, alternative_value);
  return parameter;
}

}  // namespace rclcpp::detail
