// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node_options.hpp"

#include "rclcpp/detail/rcl_arguments.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

NodeOptions& NodeOptions::context(Context::SharedPtr context) {
  context_ = std::move(context);
  return *this;
}

NodeOptions& NodeOptions::arguments(const std::vector<std::string>& arguments) {
  arguments_ = arguments;
  rcl_node_options_.reset();
  return *this;
}

NodeOptions& NodeOptions::use_global_arguments(bool use_global_arguments) {
  use_global_arguments_ = use_global_arguments;
  rcl_node_options_.reset();
  return *this;
}

NodeOptions& NodeOptions::parameter_overrides(const std::vector<Parameter>& parameter_overrides) {
  parameter_overrides_ = parameter_overrides;
  return *this;
}

NodeOptions& NodeOptions::use_intra_process_comms(bool use_intra_process_comms) {
  use_intra_process_comms_ = use_intra_process_comms;
  return *this;
}

NodeOptions& NodeOptions::enable_topic_statistics(bool enable_topic_statistics) {
  enable_topic_statistics_ = enable_topic_statistics;
  return *this;
}

NodeOptions& NodeOptions::enable_rosout(bool enable_rosout) {
  enable_rosout_ = enable_rosout;
  rcl_node_options_.reset();
  return *this;
}

NodeOptions& NodeOptions::enable_logger_service(bool enable_logger_service) {
  enable_logger_service_ = enable_logger_service;
  return *this;
}

NodeOptions& NodeOptions::rosout_qos(const QoS& rosout_qos) {
  rosout_qos_ = rosout_qos;
  rcl_node_options_.reset();
  return *this;
}

NodeOptions& NodeOptions::start_parameter_services(bool start_parameter_services) {
  start_parameter_services_ = start_parameter_services;
  return *this;
}

NodeOptions& NodeOptions::start_parameter_event_publisher(bool start_parameter_event_publisher) {
  start_parameter_event_publisher_ = start_parameter_event_publisher;
  return *this;
}

NodeOptions& NodeOptions::parameter_event_qos(const QoS& parameter_event_qos) {
  parameter_event_qos_ = parameter_event_qos;
  return *this;
}

NodeOptions& NodeOptions::allow_undeclared_parameters(bool allow_undeclared_parameters) {
  allow_undeclared_parameters_ = allow_undeclared_parameters;
  return *this;
}

NodeOptions& NodeOptions::automatically_declare_parameters_from_overrides(
    bool automatically_declare_parameters_from_overrides) {
  automatically_declare_parameters_from_overrides_ = automatically_declare_parameters_from_overrides;
  return *this;
}

NodeOptions& NodeOptions::clock_type(rcl_clock_type_t clock_type) {
  clock_type_ = clock_type;
  return *this;
}

NodeOptions& NodeOptions::parameter_event_publisher_options(
    const PublisherOptionsBase& parameter_event_publisher_options) {
  parameter_event_publisher_options_ = parameter_event_publisher_options;
  return *this;
}

NodeOptions& NodeOptions::clock_qos(const QoS& clock_qos) {
  clock_qos_ = clock_qos;
  return *this;
}

NodeOptions& NodeOptions::use_clock_thread(bool use_clock_thread) {
  use_clock_thread_ = use_clock_thread;
  return *this;
}

NodeOptions& NodeOptions::allocator(rcl_allocator_t allocator) {
  allocator_ = allocator;
  rcl_node_options_.reset();
  return *this;
}

const rcl_node_options_t* NodeOptions::get_rcl_node_options() const {
  if (!rcl_node_options_) {
    rcl_node_options_ = make_rcl_node_options();
  }
  return rcl_node_options_.get();
}

std::shared_ptr<const rcl_node_options_t> NodeOptions::make_rcl_node_options() const {
  const std::shared_ptr<rcl_node_options_t> options(new rcl_node_options_t(rcl_node_get_default_options()),
                                                    [](rcl_node_options_t* finished) {
                                                      detail::ignore_error(rcl_node_options_fini(finished));
                                                      delete finished;
                                                    });
  options->allocator = allocator_;
  options->use_global_arguments = use_global_arguments_;
  options->enable_rosout = enable_rosout_;
  options->rosout_qos = rosout_qos_.get_rmw_qos_profile();
  detail::parse_arguments(arguments_, options->arguments);
  return options;
}

}  // namespace rclcpp
