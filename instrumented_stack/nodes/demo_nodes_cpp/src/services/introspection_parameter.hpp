// SPDX-License-Identifier: Apache-2.0
// The parameter that turns on service introspection of a demo node.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rcl/service_introspection.h"
#include "rcl_interfaces/msg/set_parameters_result.hpp"
#include "rclcpp/rclcpp.hpp"

namespace demo_nodes_cpp {

// Declares a string parameter: disabled (the default), metadata or contents. Calls `configure` with its meaning in the
// constructor and at every change. Throws if the command line sets another value.
class IntrospectionParameter {
 public:
  using Configure = std::function<void(rcl_service_introspection_state_t)>;

  IntrospectionParameter(rclcpp::Node& node, std::string name, Configure configure)
      : name_(std::move(name)), configure_(std::move(configure)) {
    check_ = node.add_on_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) { return check(parameters); });
    // Called only after the change, because a callback that checks values must have no effect.
    apply_ = node.add_post_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) { apply(parameters); });
    node.declare_parameter(name_, "disabled");
  }
  IntrospectionParameter(const IntrospectionParameter&) = delete;
  IntrospectionParameter& operator=(const IntrospectionParameter&) = delete;

 private:
  static const std::map<std::string, rcl_service_introspection_state_t>& states() {
    static const std::map<std::string, rcl_service_introspection_state_t> states{
        {"disabled", RCL_SERVICE_INTROSPECTION_OFF},
        {"metadata", RCL_SERVICE_INTROSPECTION_METADATA},
        {"contents", RCL_SERVICE_INTROSPECTION_CONTENTS}};
    return states;
  }

  rcl_interfaces::msg::SetParametersResult check(const std::vector<rclcpp::Parameter>& parameters) const {
    rcl_interfaces::msg::SetParametersResult result;
    result.successful = true;
    for (const rclcpp::Parameter& parameter : parameters) {
      if (parameter.get_name() == name_ && states().count(parameter.as_string()) == 0) {
        result.successful = false;
        result.reason = "must be one of 'disabled', 'metadata', or 'contents'";
      }
    }
    return result;
  }

  void apply(const std::vector<rclcpp::Parameter>& parameters) const {
    for (const rclcpp::Parameter& parameter : parameters) {
      if (parameter.get_name() == name_) {
        configure_(states().at(parameter.as_string()));
      }
    }
  }

  std::string name_;
  Configure configure_;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr check_;
  rclcpp::node_interfaces::PostSetParametersCallbackHandle::SharedPtr apply_;
};

}  // namespace demo_nodes_cpp
