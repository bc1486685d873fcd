// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_event_handler.hpp"

#include <stdexcept>
#include <utility>

#include "rclcpp/exceptions.hpp"

namespace rclcpp {

namespace {

template <typename HandleT>
void remove(std::list<std::weak_ptr<HandleT>>& handles, const std::shared_ptr<HandleT>& handle) {
  for (auto found = handles.begin(); found != handles.end(); ++found) {
    if (found->lock() == handle) {
      handles.erase(found);
      return;
    }
  }
  throw std::runtime_error("Callback doesn't exist");
}

// Returns the living handles and forgets the others.
template <typename HandleT>
std::vector<std::shared_ptr<HandleT>> living(std::list<std::weak_ptr<HandleT>>& handles) {
  std::vector<std::shared_ptr<HandleT>> result;
  for (auto handle = handles.begin(); handle != handles.end();) {
    if (auto alive = handle->lock()) {
      result.push_back(std::move(alive));
      ++handle;
    } else {
      handle = handles.erase(handle);
    }
  }
  return result;
}

}  // namespace

ParameterEventCallbackHandle::SharedPtr ParameterEventHandler::add_parameter_event_callback(
    ParameterEventCallbackType callback) {
  auto handle = std::make_shared<ParameterEventCallbackHandle>();
  handle->callback = std::move(callback);
  const std::lock_guard lock(callbacks_->mutex);
  callbacks_->event_callbacks_.push_front(handle);
  return handle;
}

void ParameterEventHandler::remove_parameter_event_callback(const ParameterEventCallbackHandle::SharedPtr& handle) {
  const std::lock_guard lock(callbacks_->mutex);
  remove(callbacks_->event_callbacks_, handle);
}

std::string ParameterEventHandler::full_name(const std::string& node_name) const {
  if (node_name.empty()) {
    return node_base_->get_fully_qualified_name();
  }
  if (node_name.front() == '/') {
    return node_name;
  }
  const std::string node_namespace = node_base_->get_namespace();
  return (node_namespace.back() == '/' ? node_namespace : node_namespace + "/") + node_name;
}

bool ParameterEventHandler::configure_nodes_filter(const std::vector<std::string>& node_names) {
  if (node_names.empty() && !subscription_->is_cft_enabled()) {
    return true;
  }
  std::string expression;
  std::vector<std::string> parameters;
  for (const std::string& node_name : node_names) {
    expression += (expression.empty() ? "node = %" : " OR node = %") + std::to_string(parameters.size());
    parameters.push_back("'" + full_name(node_name) + "'");
  }
  try {
    subscription_->set_content_filter(expression, parameters);
  } catch (const exceptions::RCLError&) {
    return false;
  }
  return subscription_->is_cft_enabled() != node_names.empty();
}

ParameterCallbackHandle::SharedPtr ParameterEventHandler::add_parameter_callback(const std::string& parameter_name,
                                                                                 ParameterCallbackType callback,
                                                                                 const std::string& node_name) {
  auto handle = std::make_shared<ParameterCallbackHandle>();
  handle->parameter_name = parameter_name;
  handle->node_name = full_name(node_name);
  handle->callback = std::move(callback);
  const std::lock_guard lock(callbacks_->mutex);
  callbacks_->parameter_callbacks_.push_front(handle);
  return handle;
}

void ParameterEventHandler::remove_parameter_callback(const ParameterCallbackHandle::SharedPtr& handle) {
  const std::lock_guard lock(callbacks_->mutex);
  remove(callbacks_->parameter_callbacks_, handle);
}

bool ParameterEventHandler::get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event,
                                                     Parameter& parameter, const std::string& parameter_name,
                                                     const std::string& node_name) {
  if (event.node != node_name) {
    return false;
  }
  for (const auto* values : {&event.new_parameters, &event.changed_parameters}) {
    for (const rcl_interfaces::msg::Parameter& value : *values) {
      if (value.name == parameter_name) {
        parameter = Parameter::from_parameter_msg(value);
        return true;
      }
    }
  }
  return false;
}

Parameter ParameterEventHandler::get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event,
                                                          const std::string& parameter_name,
                                                          const std::string& node_name) {
  Parameter parameter;
  if (!get_parameter_from_event(event, parameter, parameter_name, node_name)) {
    if (event.node == node_name) {
      return Parameter(parameter_name, PARAMETER_NOT_SET);
    }
    throw std::runtime_error("The node name '" + node_name + "' of parameter '" + parameter_name +
                             "' doesn't match the node name '" + event.node + "' in parameter event");
  }
  return parameter;
}

std::vector<Parameter> ParameterEventHandler::get_parameters_from_event(
    const rcl_interfaces::msg::ParameterEvent& event) {
  std::vector<Parameter> parameters;
  for (const auto* values : {&event.new_parameters, &event.changed_parameters}) {
    for (const rcl_interfaces::msg::Parameter& value : *values) {
      parameters.push_back(Parameter::from_parameter_msg(value));
    }
  }
  return parameters;
}

void ParameterEventHandler::Callbacks::event_callback(const rcl_interfaces::msg::ParameterEvent& event) {
  const std::lock_guard lock(mutex);
  for (const ParameterCallbackHandle::SharedPtr& handle : living(parameter_callbacks_)) {
    Parameter parameter;
    if (get_parameter_from_event(event, parameter, handle->parameter_name, handle->node_name)) {
      handle->callback(parameter);
    }
  }
  for (const ParameterEventCallbackHandle::SharedPtr& handle : living(event_callbacks_)) {
    handle->callback(event);
  }
}

}  // namespace rclcpp
