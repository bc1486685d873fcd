// SPDX-License-Identifier: Apache-2.0
// The common part of all clients, and the interface of a client for executors.
#pragma once

#include <rcl/client.h>
#include <rcl/service_introspection.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

class Clock;

class ClientBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(ClientBase)

  // Throws exceptions::InvalidServiceNameError or exceptions::RCLError.
  ClientBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_service_type_support_t& type_support,
             const std::string& service_name, const QoS& qos);
  virtual ~ClientBase();
  RCLCPP_DISABLE_COPY(ClientBase)

  // The full, remapped name.
  const char* get_service_name() const;
  QoS get_request_publisher_actual_qos() const;
  QoS get_response_subscription_actual_qos() const;

  // Whether a service would answer a request.
  bool service_is_ready() const;
  // Waits until a service is ready. Returns false after `timeout`, or when the context ends. A negative timeout waits
  // forever.
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_service(std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return wait_for_service_nanoseconds(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  // Takes the next response into `response_out`, which points to a response of this client's type. Returns false if
  // there is none, or if it was for another client.
  bool take_type_erased_response(void* response_out, rmw_request_id_t& request_header_out);

  // Executors call it for a client that is ready. It takes one response and passes it to the caller that waits for it.
  void execute();

  std::shared_ptr<rcl_client_t> get_client_handle() { return client_handle_; }
  std::shared_ptr<const rcl_client_t> get_client_handle() const { return client_handle_; }

  // For executors that are notified instead of waiting. `callback` gets the number of new responses; it is also called
  // for those that already wait to be taken when it is set. Threads of the middleware call it, so it must only take
  // note. Throws std::invalid_argument for an empty callback. Do not call either function from the callback.
  void set_on_new_response_callback(std::function<void(size_t)> callback);
  void clear_on_new_response_callback();
  // Sets whether a wait set uses this client; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // Turns service introspection on or off: the client publishes requests sent and responses taken on its name and
  // "/_service_event". `qos_service_event_pub` only applies when it is turned on. The clock gives the events their
  // times. Any thread. Throws exceptions::RCLError; exceptions::RCLInvalidArgument for a null clock.
  void configure_introspection(std::shared_ptr<Clock> clock, const QoS& qos_service_event_pub,
                               rcl_service_introspection_state_t introspection_state);

  // The group that serves this client, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

  // Executors make these of each client: a message to take a response into, its header, and the call that passes the
  // response on.
  virtual std::shared_ptr<void> create_response() = 0;
  virtual std::shared_ptr<rmw_request_id_t> create_request_header() { return std::make_shared<rmw_request_id_t>(); }
  virtual void handle_response(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> response) = 0;

 protected:
  // For a derived class that creates the client in `client_handle_` itself.
  ClientBase(node_interfaces::NodeBaseInterface* node_base,
             std::shared_ptr<node_interfaces::NodeGraphInterface> node_graph);

  // Returns the sequence number of the request. Throws exceptions::RCLError.
  int64_t send_type_erased_request(const void* request);

  std::shared_ptr<rcl_node_t> node_handle_;
  std::shared_ptr<Context> context_;
  std::shared_ptr<rcl_client_t> client_handle_;

 private:
  friend class Executor;

  bool wait_for_service_nanoseconds(std::chrono::nanoseconds timeout);

  CallbackGroup::WeakPtr callback_group_;
  detail::OnReadyCallback on_ready_;
  std::atomic_bool in_use_by_wait_set_{false};
  std::uint64_t passed_over_ = 0;  // of the executor
  const rosidl_service_type_support_t* const introspected_type_;
  std::mutex introspection_mutex_;              // guards the clock
  std::shared_ptr<Clock> introspection_clock_;  // rcl points into it
};

}  // namespace rclcpp
