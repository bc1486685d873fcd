// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/client_base.hpp"

#include <rcl/graph.h>
#include <rmw/wait_for_graph_change.h>
#include <tracetools/tracetools.h>

#include <algorithm>

#include "base/rcl_entity.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

}  // namespace

ClientBase::ClientBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_service_type_support_t& type_support,
                       const std::string& service_name, const QoS& qos)
    : node_handle_(node_base->get_shared_rcl_node_handle()),
      context_(node_base->get_context()),
      introspected_type_(&type_support) {
  rcl_client_options_t options = rcl_client_get_default_options();
  options.qos = qos.get_rmw_qos_profile();

  auto client = std::make_unique<rcl_client_t>(rcl_get_zero_initialized_client());
  const rcl_ret_t ret =
      rcl_client_init(client.get(), node_handle_.get(), &type_support, service_name.c_str(), &options);
  if (ret == RCL_RET_SERVICE_NAME_INVALID) {
    detail::throw_invalid_service_name(service_name);
  }
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "could not create client of service '" + service_name + "'");
  }
  client_handle_ =
      detail::shared_entity(std::move(client), node_handle_, rcl_client_fini, "failed to finalize a client");
}

ClientBase::ClientBase(node_interfaces::NodeBaseInterface* node_base,
                       std::shared_ptr<node_interfaces::NodeGraphInterface> /*node_graph*/)
    : node_handle_(node_base->get_shared_rcl_node_handle()),
      context_(node_base->get_context()),
      introspected_type_(nullptr) {
  client_handle_ = detail::shared_entity(std::make_unique<rcl_client_t>(rcl_get_zero_initialized_client()),
                                         node_handle_, rcl_client_fini, "failed to finalize a client");
}

ClientBase::~ClientBase() {
  clear_on_new_response_callback();
  if (const CallbackGroup::SharedPtr group = callback_group_.lock()) {
    group->entity_removed();
  }
}

const char* ClientBase::get_service_name() const {
  return rcl_client_get_service_name(client_handle_.get());
}

QoS ClientBase::get_request_publisher_actual_qos() const {
  return detail::qos_of(rcl_client_request_publisher_get_actual_qos(client_handle_.get()), RCL_RET_CLIENT_INVALID);
}

QoS ClientBase::get_response_subscription_actual_qos() const {
  return detail::qos_of(rcl_client_response_subscription_get_actual_qos(client_handle_.get()), RCL_RET_CLIENT_INVALID);
}

bool ClientBase::service_is_ready() const {
  bool is_ready = false;
  const rcl_ret_t ret = rcl_service_server_is_available(node_handle_.get(), client_handle_.get(), &is_ready);
  if (ret == RCL_RET_NODE_INVALID && !rcl_context_is_valid(node_handle_->context)) {
    rcl_reset_error();
    return false;
  }
  require_ok(ret, "rcl_service_server_is_available failed");
  return is_ready;
}

bool ClientBase::wait_for_service_nanoseconds(nanoseconds timeout) {
  if (service_is_ready()) {
    return true;
  }
  if (timeout == nanoseconds::zero() || !context_->is_valid()) {
    return false;
  }
  const auto start = steady_clock::now();
  const rmw_node_t* node = rcl_node_get_rmw_handle(node_handle_.get());
  uint64_t changes = 0;  // any value: the first wait returns at once unless the graph never changed
  nanoseconds left = timeout;
  while (context_->is_valid() && !service_is_ready()) {
    // Waits for any change of the graph. Shutdown ends it, too.
    if (rmw_wait_for_graph_change(node, &changes, left.count()) == RMW_RET_TIMEOUT) {
      break;
    }
    if (timeout >= nanoseconds::zero()) {
      left = std::max(timeout - (steady_clock::now() - start), nanoseconds::zero());
    }
  }
  return context_->is_valid() && service_is_ready();
}

bool ClientBase::take_type_erased_response(void* response_out, rmw_request_id_t& request_header_out) {
  const rcl_ret_t ret = rcl_take_response(client_handle_.get(), &request_header_out, response_out);
  if (ret == RCL_RET_CLIENT_TAKE_FAILED) {
    rcl_reset_error();
    return false;
  }
  require_ok(ret, "failed to take a response");
  return true;
}

void ClientBase::execute() {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_client, static_cast<const void*>(client_handle_.get()));
  std::shared_ptr<rmw_request_id_t> header = create_request_header();
  std::shared_ptr<void> response = create_response();
  // If a response cannot be read, it is lost, but the program goes on.
  bool taken = false;
  try {
    taken = take_type_erased_response(response.get(), *header);
  } catch (const exceptions::RCLError& error) {
    RCLCPP_ERROR(get_logger("rclcpp"), "executor failed to take a response of service '%s': %s", get_service_name(),
                 error.what());
  }
  if (taken) {
    [[maybe_unused]] const int64_t sequence_number = header->sequence_number;
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_client_callback_start, static_cast<const void*>(client_handle_.get()),
                              sequence_number);
    handle_response(std::move(header), std::move(response));
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_client_callback_end, static_cast<const void*>(client_handle_.get()),
                              sequence_number);
  }
}

int64_t ClientBase::send_type_erased_request(const void* request) {
  int64_t sequence_number = 0;
  require_ok(rcl_send_request(client_handle_.get(), request, &sequence_number), "failed to send request");
  return sequence_number;
}

void ClientBase::configure_introspection(std::shared_ptr<Clock> clock, const QoS& qos_service_event_pub,
                                         rcl_service_introspection_state_t introspection_state) {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos_service_event_pub.get_rmw_qos_profile();
  const std::lock_guard lock(introspection_mutex_);
  require_ok(rcl_client_configure_service_introspection(client_handle_.get(), node_handle_.get(),
                                                        clock ? clock->get_clock_handle() : nullptr, introspected_type_,
                                                        options, introspection_state),
             "failed to configure client introspection");
  introspection_clock_ = std::move(clock);
}

void ClientBase::set_on_new_response_callback(std::function<void(size_t)> callback) {
  on_ready_.set(std::move(callback), "set_on_new_response_callback", "client",
                [this](rcl_event_callback_t function, const void* user_data) {
                  require_ok(rcl_client_set_on_new_response_callback(client_handle_.get(), function, user_data),
                             "failed to set the callback of a client");
                });
}

void ClientBase::clear_on_new_response_callback() {
  on_ready_.clear([this](rcl_event_callback_t function, const void* user_data) {
    detail::ignore_error(rcl_client_set_on_new_response_callback(client_handle_.get(), function, user_data));
  });
}

}  // namespace rclcpp
