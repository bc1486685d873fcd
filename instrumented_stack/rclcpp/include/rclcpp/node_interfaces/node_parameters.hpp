// SPDX-License-Identifier: Apache-2.0
// The parameters of a node: the declared ones with values and descriptions, their services, and the callbacks for
// changes.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <rcl_interfaces/msg/list_parameters_result.hpp>
#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <string>
#include <vector>

#include "rclcpp/clock.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp/parameter_service.hpp"
#include "rclcpp/publisher.hpp"

namespace rclcpp::node_interfaces {

// Thread safe. Callbacks run in the thread that changes parameters.
class NodeParameters : public NodeParametersInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeParameters)

  // Throws what parsing the node's arguments and creating the services and /parameter_events throw.
  NodeParameters(NodeBaseInterface::SharedPtr node_base, const NodeServicesInterface::SharedPtr& node_services,
                 Clock::SharedPtr clock, const NodeOptions& options, const rcl_node_options_t& rcl_options);
  ~NodeParameters() override;

  const ParameterValue& declare_parameter(const std::string& name, const ParameterValue& default_value,
                                          const Descriptor& descriptor = Descriptor(),
                                          bool ignore_override = false) override;
  const ParameterValue& declare_parameter(const std::string& name, ParameterType type,
                                          const Descriptor& descriptor = Descriptor(),
                                          bool ignore_override = false) override;
  void undeclare_parameter(const std::string& name) override;
  bool has_parameter(const std::string& name) const override;

  std::vector<Result> set_parameters(const std::vector<Parameter>& parameters) override;
  Result set_parameters_atomically(const std::vector<Parameter>& parameters) override;

  Parameter get_parameter(const std::string& name) const override;
  bool get_parameter(const std::string& name, Parameter& parameter) const override;
  std::vector<Parameter> get_parameters(const std::vector<std::string>& names) const override;
  bool get_parameters_by_prefix(const std::string& prefix, std::map<std::string, Parameter>& parameters) const override;

  std::vector<Descriptor> describe_parameters(const std::vector<std::string>& names) const override;
  std::vector<uint8_t> get_parameter_types(const std::vector<std::string>& names) const override;
  rcl_interfaces::msg::ListParametersResult list_parameters(const std::vector<std::string>& prefixes,
                                                            uint64_t depth) const override;

  OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      OnSetParametersCallbackType callback) override;
  PreSetParametersCallbackHandle::SharedPtr add_pre_set_parameters_callback(
      PreSetParametersCallbackType callback) override;
  PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      PostSetParametersCallbackType callback) override;
  void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) override;
  void remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) override;
  void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) override;

  void enable_parameter_modification() override;

  const std::map<std::string, ParameterValue>& get_parameter_overrides() const override { return overrides_; }

 private:
  struct Declared {
    ParameterValue value;
    Descriptor descriptor;
  };
  class ChangeScope;

  const ParameterValue& declare(const std::string& name, const ParameterValue* default_value, Descriptor descriptor,
                                bool ignore_override);
  Result check_names(const std::vector<Parameter>& parameters) const;
  Result check_values(const std::vector<Parameter>& parameters) const;
  void apply(const std::vector<Parameter>& parameters);
  Result call_on_set_callbacks(const std::vector<Parameter>& parameters);
  void publish(const rcl_interfaces::msg::ParameterEvent& event);
  rcl_interfaces::msg::ParameterEvent new_event() const;

  NodeBaseInterface::SharedPtr node_base_;
  Clock::SharedPtr clock_;
  bool allow_undeclared_;
  std::map<std::string, ParameterValue> overrides_;
  std::unique_ptr<ParameterService> services_;
  Publisher<rcl_interfaces::msg::ParameterEvent>::SharedPtr events_publisher_;

  mutable std::recursive_mutex mutex_;  // recursive: callbacks may read parameters
  bool changing_ = false;
  std::map<std::string, Declared> parameters_;
  std::list<PreSetParametersCallbackHandle::WeakPtr> pre_set_callbacks_;
  std::list<OnSetParametersCallbackHandle::WeakPtr> on_set_callbacks_;
  std::list<PostSetParametersCallbackHandle::WeakPtr> post_set_callbacks_;
};

}  // namespace rclcpp::node_interfaces
