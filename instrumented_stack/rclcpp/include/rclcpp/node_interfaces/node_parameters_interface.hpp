// SPDX-License-Identifier: Apache-2.0
// The parameters of a node: the declared ones with values and descriptions, and the callbacks for changes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <rcl_interfaces/msg/list_parameters_result.hpp>
#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <string>
#include <vector>

#include "rclcpp/macros.hpp"
#include "rclcpp/parameter.hpp"

namespace rclcpp::node_interfaces {

// Registered callbacks live as long as their handle.
struct PreSetParametersCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(PreSetParametersCallbackHandle)
  using PreSetParametersCallbackType = std::function<void(std::vector<Parameter>&)>;
  PreSetParametersCallbackType callback;
};

struct OnSetParametersCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(OnSetParametersCallbackHandle)
  using OnSetParametersCallbackType =
      std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)>;
  OnSetParametersCallbackType callback;
};

struct PostSetParametersCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(PostSetParametersCallbackHandle)
  using PostSetParametersCallbackType = std::function<void(const std::vector<Parameter>&)>;
  PostSetParametersCallbackType callback;
};

class NodeParametersInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeParametersInterface)
  using Descriptor = rcl_interfaces::msg::ParameterDescriptor;
  using Result = rcl_interfaces::msg::SetParametersResult;
  using OnSetParametersCallbackType = OnSetParametersCallbackHandle::OnSetParametersCallbackType;
  using PostSetParametersCallbackType = PostSetParametersCallbackHandle::PostSetParametersCallbackType;
  using PreSetParametersCallbackType = PreSetParametersCallbackHandle::PreSetParametersCallbackType;

  virtual ~NodeParametersInterface() = default;

  // Node documents the exceptions.
  virtual const ParameterValue& declare_parameter(const std::string& name, const ParameterValue& default_value,
                                                  const Descriptor& descriptor = Descriptor(),
                                                  bool ignore_override = false) = 0;
  virtual const ParameterValue& declare_parameter(const std::string& name, ParameterType type,
                                                  const Descriptor& descriptor = Descriptor(),
                                                  bool ignore_override = false) = 0;
  virtual void undeclare_parameter(const std::string& name) = 0;
  virtual bool has_parameter(const std::string& name) const = 0;

  virtual std::vector<Result> set_parameters(const std::vector<Parameter>& parameters) = 0;
  virtual Result set_parameters_atomically(const std::vector<Parameter>& parameters) = 0;

  virtual Parameter get_parameter(const std::string& name) const = 0;
  virtual bool get_parameter(const std::string& name, Parameter& parameter) const = 0;
  virtual std::vector<Parameter> get_parameters(const std::vector<std::string>& names) const = 0;
  // Gets the set parameters `prefix.x` by the name x.
  virtual bool get_parameters_by_prefix(const std::string& prefix,
                                        std::map<std::string, Parameter>& parameters) const = 0;

  virtual std::vector<Descriptor> describe_parameters(const std::vector<std::string>& names) const = 0;
  virtual std::vector<uint8_t> get_parameter_types(const std::vector<std::string>& names) const = 0;
  // Lists the names below the prefixes, at most `depth` levels down (0: all).
  virtual rcl_interfaces::msg::ListParametersResult list_parameters(const std::vector<std::string>& prefixes,
                                                                    uint64_t depth) const = 0;

  virtual OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      OnSetParametersCallbackType callback) = 0;
  virtual PreSetParametersCallbackHandle::SharedPtr add_pre_set_parameters_callback(
      PreSetParametersCallbackType callback) = 0;
  virtual PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      PostSetParametersCallbackType callback) = 0;
  // Throw std::runtime_error if the handle is not registered.
  virtual void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) = 0;
  virtual void remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) = 0;
  virtual void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) = 0;

  // Called in a callback for parameters: the rest of it may declare and set parameters, which is otherwise refused.
  // Subscriptions and publishers that are created in a callback call it before they declare `qos_overrides.…`.
  virtual void enable_parameter_modification() {}

  // Overrides by name, from the command line, parameter files and NodeOptions. Only those for this node.
  virtual const std::map<std::string, ParameterValue>& get_parameter_overrides() const = 0;
};

}  // namespace rclcpp::node_interfaces
