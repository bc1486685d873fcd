// SPDX-License-Identifier: Apache-2.0
// The common part of all services, and the interface of a service for executors.
#pragma once

#include <rcl/service.h>
#include <rcl/service_introspection.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "rclcpp/any_service_callback.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

class Clock;

class ServiceBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(ServiceBase)

  // Throws exceptions::InvalidServiceNameError or exceptions::RCLError.
  ServiceBase(node_interfaces::NodeBaseInterface* node_base, const rosidl_service_type_support_t& type_support,
              const std::string& service_name, const QoS& qos);
  // With the options of rcl, of which only those of the middleware have an effect. Throws the same.
  ServiceBase(std::shared_ptr<rcl_node_t> node_handle, const rosidl_service_type_support_t& type_support,
              const std::string& service_name, const rcl_service_options_t& options);
  // Takes over a service that exists already, of this type. Throws std::runtime_error unless rcl has initialised it.
  ServiceBase(std::shared_ptr<rcl_node_t> node_handle, std::shared_ptr<rcl_service_t> service_handle,
              const rosidl_service_type_support_t& type_support);
  virtual ~ServiceBase();
  RCLCPP_DISABLE_COPY(ServiceBase)

  // The full, remapped name.
  const char* get_service_name() const;
  QoS get_request_subscription_actual_qos() const;
  QoS get_response_publisher_actual_qos() const;

  // Takes the next request into `request_out`, which points to a request of this service's type. Returns false if there
  // is none.
  bool take_type_erased_request(void* request_out, rmw_request_id_t& request_id_out);

  // Executors call it for a service that is ready. It takes one request and runs the callback.
  void execute();

  std::shared_ptr<rcl_service_t> get_service_handle() { return service_handle_; }
  std::shared_ptr<const rcl_service_t> get_service_handle() const { return service_handle_; }

  // For executors that are notified instead of waiting. `callback` gets the number of new requests; it is also called
  // for those that already wait to be taken when it is set. Threads of the middleware call it, so it must only take
  // note. Throws std::invalid_argument for an empty callback. Do not call either function from the callback.
  void set_on_new_request_callback(std::function<void(size_t)> callback);
  void clear_on_new_request_callback();
  // Sets whether a wait set uses this service; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // Turns service introspection on or off: the service publishes requests taken and responses sent on its name and
  // "/_service_event". `qos_service_event_pub` only applies when it is turned on. The clock gives the events their
  // times. Any thread. Throws exceptions::RCLError; exceptions::RCLInvalidArgument for a null clock.
  void configure_introspection(std::shared_ptr<Clock> clock, const QoS& qos_service_event_pub,
                               rcl_service_introspection_state_t introspection_state);

  // The group that serves this service, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

  // Executors make these of each service: a message to take a request into, its header, and the call that answers it.
  virtual std::shared_ptr<void> create_request() = 0;
  virtual std::shared_ptr<rmw_request_id_t> create_request_header() { return std::make_shared<rmw_request_id_t>(); }
  virtual void handle_request(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> request) = 0;

 protected:
  // For a derived class that creates the service in `service_handle_` itself.
  explicit ServiceBase(std::shared_ptr<rcl_node_t> node_handle);

  // Only warns if the client cannot receive the response yet. Throws exceptions::RCLError on other failures.
  void send_type_erased_response(rmw_request_id_t& request_id, void* response);

  // Call it in the most derived constructor, when the callback has its final address.
  void trace_creation(const AnyServiceCallbackBase& callback);

  std::shared_ptr<rcl_node_t> node_handle_;
  std::shared_ptr<rcl_service_t> service_handle_;

 private:
  friend class Executor;

  CallbackGroup::WeakPtr callback_group_;
  detail::OnReadyCallback on_ready_;
  std::atomic_bool in_use_by_wait_set_{false};
  std::uint64_t passed_over_ = 0;  // of the executor
  const rosidl_service_type_support_t* const introspected_type_;
  std::mutex introspection_mutex_;              // guards the clock
  std::shared_ptr<Clock> introspection_clock_;  // rcl points into it
  const void* traced_callback_ = nullptr;       // set by trace_creation()
};

}  // namespace rclcpp
