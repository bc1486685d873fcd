// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/service_base.hpp"

#include <tracetools/tracetools.h>

#include "base/rcl_entity.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

rcl_service_options_t options_with(const QoS& qos) {
  rcl_service_options_t options = rcl_service_get_default_options();
  options.qos = qos.get_rmw_qos_profile();
  return options;
}

}  // namespace

ServiceBase::ServiceBase(node_interfaces::NodeBaseInterface* node_base,
                         const rosidl_service_type_support_t& type_support, const std::string& service_name,
                         const QoS& qos)
    : ServiceBase(node_base->get_shared_rcl_node_handle(), type_support, service_name, options_with(qos)) {}

ServiceBase::ServiceBase(std::shared_ptr<rcl_node_t> node_handle, const rosidl_service_type_support_t& type_support,
                         const std::string& service_name, const rcl_service_options_t& options)
    : node_handle_(std::move(node_handle)), introspected_type_(&type_support) {
  auto service = std::make_unique<rcl_service_t>(rcl_get_zero_initialized_service());
  const rcl_ret_t ret =
      rcl_service_init(service.get(), node_handle_.get(), &type_support, service_name.c_str(), &options);
  if (ret == RCL_RET_SERVICE_NAME_INVALID) {
    detail::throw_invalid_service_name(service_name);
  }
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "could not create service '" + service_name + "'");
  }
  service_handle_ =
      detail::shared_entity(std::move(service), node_handle_, rcl_service_fini, "failed to finalize a service");
}

ServiceBase::ServiceBase(std::shared_ptr<rcl_node_t> node_handle, std::shared_ptr<rcl_service_t> service_handle,
                         const rosidl_service_type_support_t& type_support)
    : node_handle_(std::move(node_handle)),
      service_handle_(std::move(service_handle)),
      introspected_type_(&type_support) {
  if (!rcl_service_is_valid(service_handle_.get())) {
    rcl_reset_error();
    throw std::runtime_error("rcl_service_t in constructor argument must be initialized beforehand.");
  }
}

ServiceBase::ServiceBase(std::shared_ptr<rcl_node_t> node_handle)
    : node_handle_(std::move(node_handle)), introspected_type_(nullptr) {}

ServiceBase::~ServiceBase() {
  clear_on_new_request_callback();
  if (traced_callback_) {
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, traced_callback_);
  }
  if (const CallbackGroup::SharedPtr group = callback_group_.lock()) {
    group->entity_removed();
  }
}

const char* ServiceBase::get_service_name() const {
  return rcl_service_get_service_name(service_handle_.get());
}

QoS ServiceBase::get_request_subscription_actual_qos() const {
  return detail::qos_of(rcl_service_request_subscription_get_actual_qos(service_handle_.get()),
                        RCL_RET_SERVICE_INVALID);
}

QoS ServiceBase::get_response_publisher_actual_qos() const {
  return detail::qos_of(rcl_service_response_publisher_get_actual_qos(service_handle_.get()), RCL_RET_SERVICE_INVALID);
}

bool ServiceBase::take_type_erased_request(void* request_out, rmw_request_id_t& request_id_out) {
  const rcl_ret_t ret = rcl_take_request(service_handle_.get(), &request_id_out, request_out);
  if (ret == RCL_RET_SERVICE_TAKE_FAILED) {
    rcl_reset_error();
    return false;
  }
  require_ok(ret, "failed to take a request");
  return true;
}

void ServiceBase::execute() {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_service, static_cast<const void*>(service_handle_.get()));
  std::shared_ptr<rmw_request_id_t> header = create_request_header();
  std::shared_ptr<void> request = create_request();
  // If a request cannot be read, it is lost, but the program goes on.
  bool taken = false;
  try {
    taken = take_type_erased_request(request.get(), *header);
  } catch (const exceptions::RCLError& error) {
    RCLCPP_ERROR(get_logger("rclcpp"), "executor failed to take a request of service '%s': %s", get_service_name(),
                 error.what());
  }
  if (taken) {
    handle_request(std::move(header), std::move(request));
  }
}

void ServiceBase::send_type_erased_response(rmw_request_id_t& request_id, void* response) {
  const rcl_ret_t ret = rcl_send_response(service_handle_.get(), &request_id, response);
  if (ret == RCL_RET_TIMEOUT) {
    RCLCPP_WARN(get_logger("rclcpp"), "failed to send response to %s (timeout): %s", get_service_name(),
                rcl_get_error_string().str);
    rcl_reset_error();
    return;
  }
  require_ok(ret, "failed to send response");
}

void ServiceBase::trace_creation(const AnyServiceCallbackBase& callback) {
  traced_callback_ = &callback;
  TRACETOOLS_TRACEPOINT(rclcpp_service_callback_added, static_cast<const void*>(service_handle_.get()),
                        static_cast<const void*>(&callback));
  callback.trace_registration();
}

void ServiceBase::configure_introspection(std::shared_ptr<Clock> clock, const QoS& qos_service_event_pub,
                                          rcl_service_introspection_state_t introspection_state) {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos_service_event_pub.get_rmw_qos_profile();
  const std::lock_guard lock(introspection_mutex_);
  require_ok(rcl_service_configure_service_introspection(service_handle_.get(), node_handle_.get(),
                                                         clock ? clock->get_clock_handle() : nullptr,
                                                         introspected_type_, options, introspection_state),
             "failed to configure service introspection");
  introspection_clock_ = std::move(clock);
}

void ServiceBase::set_on_new_request_callback(std::function<void(size_t)> callback) {
  on_ready_.set(std::move(callback), "set_on_new_request_callback", "service",
                [this](rcl_event_callback_t function, const void* user_data) {
                  require_ok(rcl_service_set_on_new_request_callback(service_handle_.get(), function, user_data),
                             "failed to set the callback of a service");
                });
}

void ServiceBase::clear_on_new_request_callback() {
  on_ready_.clear([this](rcl_event_callback_t function, const void* user_data) {
    detail::ignore_error(rcl_service_set_on_new_request_callback(service_handle_.get(), function, user_data));
  });
}

}  // namespace rclcpp
