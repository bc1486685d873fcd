// SPDX-License-Identifier: Apache-2.0
// Queries about a node's parameters. node_parameters.cpp changes them.
#include <algorithm>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/node_interfaces/node_parameters.hpp"

namespace rclcpp::node_interfaces {

bool NodeParameters::has_parameter(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return parameters_.count(name) > 0;
}

Parameter NodeParameters::get_parameter(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) {
    if (allow_undeclared_) {
      return Parameter(name);
    }
    throw exceptions::ParameterNotDeclaredException(name);
  }
  if (found->second.value.get_type() == PARAMETER_NOT_SET && !found->second.descriptor.dynamic_typing) {
    throw exceptions::ParameterUninitializedException(name);
  }
  return Parameter(name, found->second.value);
}

bool NodeParameters::get_parameter(const std::string& name, Parameter& parameter) const {
  const std::lock_guard lock(mutex_);
  const auto found = parameters_.find(name);
  if (found == parameters_.end() || found->second.value.get_type() == PARAMETER_NOT_SET) {
    return false;
  }
  parameter = Parameter(name, found->second.value);
  return true;
}

std::vector<Parameter> NodeParameters::get_parameters(const std::vector<std::string>& names) const {
  const std::lock_guard lock(mutex_);
  std::vector<Parameter> parameters;
  for (const std::string& name : names) {
    parameters.push_back(get_parameter(name));
  }
  return parameters;
}

bool NodeParameters::get_parameters_by_prefix(const std::string& prefix,
                                              std::map<std::string, Parameter>& parameters) const {
  const std::lock_guard lock(mutex_);
  const std::string start = prefix.empty() ? prefix : prefix + ".";
  bool any = false;
  for (const auto& [name, declared] : parameters_) {
    if (name.size() > start.size() && name.compare(0, start.size(), start) == 0) {
      parameters[name.substr(start.size())] = Parameter(name, declared.value);
      any = true;
    }
  }
  return any;
}

std::vector<NodeParameters::Descriptor> NodeParameters::describe_parameters(
    const std::vector<std::string>& names) const {
  const std::lock_guard lock(mutex_);
  std::vector<Descriptor> descriptors;
  for (const std::string& name : names) {
    const auto found = parameters_.find(name);
    if (found != parameters_.end()) {
      descriptors.push_back(found->second.descriptor);
    } else if (allow_undeclared_) {
      descriptors.emplace_back().name = name;
    } else {
      throw exceptions::ParameterNotDeclaredException(name);
    }
  }
  return descriptors;
}

std::vector<uint8_t> NodeParameters::get_parameter_types(const std::vector<std::string>& names) const {
  const std::lock_guard lock(mutex_);
  std::vector<uint8_t> types;
  for (const std::string& name : names) {
    const auto found = parameters_.find(name);
    if (found != parameters_.end()) {
      types.push_back(found->second.value.get_type());
    } else if (allow_undeclared_) {
      types.push_back(PARAMETER_NOT_SET);
    } else {
      throw exceptions::ParameterNotDeclaredException(name);
    }
  }
  return types;
}

rcl_interfaces::msg::ListParametersResult NodeParameters::list_parameters(const std::vector<std::string>& prefixes,
                                                                          uint64_t depth) const {
  const std::lock_guard lock(mutex_);
  const auto separators = [](const std::string& text) {
    return static_cast<uint64_t>(std::count(text.begin(), text.end(), '.'));
  };
  const auto wanted = [&](const std::string& name) {
    if (prefixes.empty()) {
      return depth == 0 || separators(name) < depth;
    }
    return std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
      if (name == prefix) {
        return true;
      }
      return name.compare(0, prefix.size() + 1, prefix + ".") == 0 &&
             (depth == 0 || separators(name.substr(prefix.size() + 1)) < depth);
    });
  };
  rcl_interfaces::msg::ListParametersResult result;
  for (const auto& [name, declared] : parameters_) {
    if (!wanted(name)) {
      continue;
    }
    result.names.push_back(name);
    const size_t separator = name.rfind('.');
    if (separator != std::string::npos) {
      const std::string prefix = name.substr(0, separator);
      if (std::find(result.prefixes.begin(), result.prefixes.end(), prefix) == result.prefixes.end()) {
        result.prefixes.push_back(prefix);
      }
    }
  }
  return result;
}

}  // namespace rclcpp::node_interfaces
