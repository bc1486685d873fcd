// SPDX-License-Identifier: Apache-2.0
// The options for creating a node besides its name.
#pragma once

#include <rcl/node_options.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/context.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/logger.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

class NodeOptions {
 public:
  // `allocator` is the allocator for rcl's options.
  explicit NodeOptions(rcl_allocator_t allocator = rcl_get_default_allocator()) : allocator_(allocator) {}

  Context::SharedPtr context() const { return context_; }
  NodeOptions& context(Context::SharedPtr context) { return set(context_, std::move(context)); }

  // Arguments of only this node, as on a command line: {"--ros-args", "-r", "__node:=name"}. They come before those of
  // the process.
  const std::vector<std::string>& arguments() const { return arguments_; }
  NodeOptions& arguments(const std::vector<std::string>& arguments) { return set_for_rcl(arguments_, arguments); }

  // Whether the arguments of the process apply to the node. Default true.
  bool use_global_arguments() const { return use_global_arguments_; }
  NodeOptions& use_global_arguments(bool use_global_arguments) {
    return set_for_rcl(use_global_arguments_, use_global_arguments);
  }

  // Values that parameters get when they are declared. They replace those of the command line.
  std::vector<Parameter>& parameter_overrides() { return parameter_overrides_; }
  const std::vector<Parameter>& parameter_overrides() const { return parameter_overrides_; }
  NodeOptions& parameter_overrides(const std::vector<Parameter>& parameter_overrides) {
    return set(parameter_overrides_, parameter_overrides);
  }
  template <typename ValueT>
  NodeOptions& append_parameter_override(const std::string& name, const ValueT& value) {
    parameter_overrides_.emplace_back(name, ParameterValue(value));
    return *this;
  }
  NodeOptions& append_parameter_override(const Parameter& parameter) {
    parameter_overrides_.push_back(parameter);
    return *this;
  }

  // Whether messages go to subscriptions of the same context by pointer. Default false.
  bool use_intra_process_comms() const { return use_intra_process_comms_; }
  NodeOptions& use_intra_process_comms(bool use_intra_process_comms) {
    return set(use_intra_process_comms_, use_intra_process_comms);
  }

  // Whether subscriptions publish statistics by default. Default false.
  bool enable_topic_statistics() const { return enable_topic_statistics_; }
  NodeOptions& enable_topic_statistics(bool enable_topic_statistics) {
    return set(enable_topic_statistics_, enable_topic_statistics);
  }

  // Whether log lines go to /rosout. Default true.
  bool enable_rosout() const { return enable_rosout_; }
  NodeOptions& enable_rosout(bool enable_rosout) { return set_for_rcl(enable_rosout_, enable_rosout); }
  const QoS& rosout_qos() const { return rosout_qos_; }
  NodeOptions& rosout_qos(const QoS& rosout_qos) { return set_for_rcl(rosout_qos_, rosout_qos); }

  // The level of the node's logger from its creation on. Default Unset: that of the command line, or of the process.
  Logger::Level log_level() const { return log_level_; }
  NodeOptions& log_level(Logger::Level log_level) { return set(log_level_, log_level); }

  // Whether others can read and change the levels of the process's loggers, through two services. Default false.
  bool enable_logger_service() const { return enable_logger_service_; }
  NodeOptions& enable_logger_service(bool enable_logger_service) {
    return set(enable_logger_service_, enable_logger_service);
  }

  // Whether others can read and change the parameters, through six services. Default true.
  bool start_parameter_services() const { return start_parameter_services_; }
  NodeOptions& start_parameter_services(bool start_parameter_services) {
    return set(start_parameter_services_, start_parameter_services);
  }

  // Whether changes of parameters go to /parameter_events. Default true.
  bool start_parameter_event_publisher() const { return start_parameter_event_publisher_; }
  NodeOptions& start_parameter_event_publisher(bool start_parameter_event_publisher) {
    return set(start_parameter_event_publisher_, start_parameter_event_publisher);
  }
  const QoS& parameter_event_qos() const { return parameter_event_qos_; }
  NodeOptions& parameter_event_qos(const QoS& parameter_event_qos) {
    return set(parameter_event_qos_, parameter_event_qos);
  }

  // Options besides the QoS, for instance the event callbacks.
  const PublisherOptionsBase& parameter_event_publisher_options() const { return parameter_event_publisher_options_; }
  NodeOptions& parameter_event_publisher_options(const PublisherOptionsBase& parameter_event_publisher_options) {
    return set(parameter_event_publisher_options_, parameter_event_publisher_options);
  }

  // Whether undeclared parameters may be set. Default false.
  bool allow_undeclared_parameters() const { return allow_undeclared_parameters_; }
  NodeOptions& allow_undeclared_parameters(bool allow_undeclared_parameters) {
    return set(allow_undeclared_parameters_, allow_undeclared_parameters);
  }

  // Whether every override declares its parameter. Default false.
  bool automatically_declare_parameters_from_overrides() const {
    return automatically_declare_parameters_from_overrides_;
  }
  NodeOptions& automatically_declare_parameters_from_overrides(bool automatically_declare_parameters_from_overrides) {
    return set(automatically_declare_parameters_from_overrides_, automatically_declare_parameters_from_overrides);
  }

  // The type of Node::get_clock(). Default RCL_ROS_TIME.
  rcl_clock_type_t clock_type() const { return clock_type_; }
  NodeOptions& clock_type(rcl_clock_type_t clock_type) { return set(clock_type_, clock_type); }

  // The QoS of the subscription of /clock while time is simulated.
  const QoS& clock_qos() const { return clock_qos_; }
  NodeOptions& clock_qos(const QoS& clock_qos) { return set(clock_qos_, clock_qos); }

  // Whether a thread of its own receives simulated time. Otherwise the spinning thread does. Default true.
  bool use_clock_thread() const { return use_clock_thread_; }
  NodeOptions& use_clock_thread(bool use_clock_thread) { return set(use_clock_thread_, use_clock_thread); }

  // The allocator for rcl's options.
  const rcl_allocator_t& allocator() const { return allocator_; }
  NodeOptions& allocator(rcl_allocator_t allocator) { return set_for_rcl(allocator_, allocator); }

  // These options for rcl, which owns the parsed arguments; valid until these options are changed or destroyed. Not
  // thread safe. Throws exceptions::UnknownROSArgsError and exceptions::RCLInvalidROSArgsError.
  const rcl_node_options_t* get_rcl_node_options() const;
  // The same options; the caller shares the ownership.
  std::shared_ptr<const rcl_node_options_t> make_rcl_node_options() const;

 private:
  template <typename T>
  NodeOptions& set(T& option, T value) {
    option = std::move(value);
    return *this;
  }
  template <typename T>
  NodeOptions& set_for_rcl(T& option, T value) {
    rcl_node_options_.reset();
    return set(option, std::move(value));
  }

  Context::SharedPtr context_ = contexts::get_global_default_context();
  std::vector<std::string> arguments_;
  std::vector<Parameter> parameter_overrides_;
  bool use_global_arguments_ = true;
  bool use_intra_process_comms_ = false;
  bool enable_topic_statistics_ = false;
  bool enable_rosout_ = true;
  QoS rosout_qos_ = RosoutQoS();
  Logger::Level log_level_ = Logger::Level::Unset;
  bool enable_logger_service_ = false;
  bool start_parameter_services_ = true;
  bool start_parameter_event_publisher_ = true;
  QoS parameter_event_qos_ = ParameterEventsQoS();
  bool allow_undeclared_parameters_ = false;
  bool automatically_declare_parameters_from_overrides_ = false;
  rcl_clock_type_t clock_type_ = RCL_ROS_TIME;
  PublisherOptionsBase parameter_event_publisher_options_;
  QoS clock_qos_ = ClockQoS();
  bool use_clock_thread_ = true;
  rcl_allocator_t allocator_;
  mutable std::shared_ptr<const rcl_node_options_t> rcl_node_options_;  // null: not made since the last change
};

}  // namespace rclcpp
