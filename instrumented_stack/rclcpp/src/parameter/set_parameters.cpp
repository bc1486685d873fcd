// SPDX-License-Identifier: Apache-2.0
// Setting parameters of a node. node_parameters.cpp declares them.
#include <set>

#include "parameter/parameter_changes.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/node_interfaces/node_parameters.hpp"

namespace rclcpp::node_interfaces {

namespace {

rcl_interfaces::msg::SetParametersResult refusal(std::string reason) {
  rcl_interfaces::msg::SetParametersResult result;
  result.successful = false;
  result.reason = std::move(reason);
  return result;
}

}  // namespace

std::vector<NodeParameters::Result> NodeParameters::set_parameters(const std::vector<Parameter>& parameters) {
  std::vector<Result> results;
  for (const Parameter& parameter : parameters) {
    results.push_back(set_parameters_atomically({parameter}));
  }
  return results;
}

// Everything is checked before anything changes, so that a refusal leaves nothing half set.
NodeParameters::Result NodeParameters::set_parameters_atomically(const std::vector<Parameter>& asked) {
  const ChangeScope scope(*this);
  std::vector<Parameter> parameters = asked;
  for (const auto& handle : detail::living(pre_set_callbacks_)) {
    handle->callback(parameters);
  }
  if (parameters.empty()) {
    return refusal(
        "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying the original "
        "parameters list.");
  }
  Result result = check_names(parameters);
  if (result.successful) {
    result = check_values(parameters);
  }
  if (result.successful) {
    result = call_on_set_callbacks(parameters);
  }
  if (result.successful) {
    apply(parameters);
  }
  return result;
}

NodeParameters::Result NodeParameters::check_names(const std::vector<Parameter>& parameters) const {
  for (const Parameter& parameter : parameters) {
    const std::string& name = parameter.get_name();
    if (name.empty()) {
      throw exceptions::InvalidParametersException("parameter name must not be empty");
    }
    const auto found = parameters_.find(name);
    if (found == parameters_.end() && !allow_undeclared_) {
      throw exceptions::ParameterNotDeclaredException("parameter '" + name +
                                                      "' cannot be set because it was not declared");
    }
    if (found != parameters_.end() && found->second.descriptor.read_only) {
      return refusal("parameter '" + name + "' cannot be set because it is read-only");
    }
  }
  Result success;
  success.successful = true;
  return success;
}

NodeParameters::Result NodeParameters::check_values(const std::vector<Parameter>& parameters) const {
  for (const Parameter& parameter : parameters) {
    const auto found = parameters_.find(parameter.get_name());
    if (parameter.get_type() == PARAMETER_NOT_SET && found != parameters_.end() &&
        found->second.value.get_type() != PARAMETER_NOT_SET && !found->second.descriptor.dynamic_typing) {
      return refusal("cannot undeclare a statically typed parameter");
    }
  }
  Result result;
  result.successful = true;
  for (const Parameter& parameter : parameters) {
    // A parameter that was not declared takes every value.
    const auto found = parameters_.find(parameter.get_name());
    if (found != parameters_.end()) {
      result = check_constraints(found->second.descriptor, parameter.get_parameter_value());
    }
    if (!result.successful) {
      return result;
    }
  }
  return result;
}

void NodeParameters::apply(const std::vector<Parameter>& parameters) {
  // What an event tells stands in the order in which it was asked for.
  rcl_interfaces::msg::ParameterEvent event = new_event();
  std::set<std::string> declared_now;
  std::vector<std::string> deleted;
  for (const Parameter& parameter : parameters) {
    const std::string& name = parameter.get_name();
    const auto [place, is_new] = parameters_.try_emplace(name);
    Declared& declared = place->second;
    if (is_new) {
      declared.descriptor.name = name;
      declared.descriptor.dynamic_typing = true;
      declared_now.insert(name);
    }
    const bool had_value = declared.value.get_type() != PARAMETER_NOT_SET;
    const bool has_value = parameter.get_type() != PARAMETER_NOT_SET;
    declared.value = parameter.get_parameter_value();
    declared.descriptor.type = parameter.get_type();
    if (declared_now.count(name) > 0) {
      if (has_value) {
        event.new_parameters.push_back(parameter.to_parameter_msg());
      }
    } else if (had_value && !has_value) {
      event.deleted_parameters.push_back(parameter.to_parameter_msg());
      deleted.push_back(name);
    } else {
      event.changed_parameters.push_back(parameter.to_parameter_msg());
    }
  }
  for (const auto& handle : detail::living(post_set_callbacks_)) {
    handle->callback(parameters);
  }
  for (const std::string& name : deleted) {
    parameters_.erase(name);
  }
  publish(event);
}

}  // namespace rclcpp::node_interfaces
