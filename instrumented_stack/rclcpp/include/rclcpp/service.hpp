// SPDX-License-Identifier: Apache-2.0
// Answers requests of one type under one name. Created by Node::create_service().
#pragma once

#include <memory>
#include <rosidl_typesupport_cpp/service_type_support.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "rclcpp/clock.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/time.hpp"

namespace rclcpp {

template <typename ServiceT>
class Service : public ServiceBase, public std::enable_shared_from_this<Service<ServiceT>> {
 public:
  using ServiceType = ServiceT;
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  RCLCPP_SMART_PTR_DEFINITIONS(Service<ServiceT>)

  Service(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
          AnyServiceCallback<ServiceT> any_callback, const QoS& qos)
      : ServiceBase(node_base, *rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>(), service_name, qos),
        any_callback_(std::move(any_callback)) {
    trace_creation(any_callback_);
  }

  // With the options of rcl.
  Service(std::shared_ptr<rcl_node_t> node_handle, const std::string& service_name,
          AnyServiceCallback<ServiceT> any_callback, const rcl_service_options_t& service_options)
      : ServiceBase(std::move(node_handle), *rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>(),
                    service_name, service_options),
        any_callback_(std::move(any_callback)) {
    trace_creation(any_callback_);
  }

  // Takes the next request without running the callback. Returns false if there is none.
  bool take_request(Request& request_out, rmw_request_id_t& request_id_out) {
    return take_type_erased_request(&request_out, request_id_out);
  }

  // For callbacks that defer the response. May be called from any thread, once per request.
  void send_response(rmw_request_id_t& request_id, Response& response) {
    send_type_erased_response(request_id, &response);
  }

  // Takes over a service that exists already, for requests in C++.
  Service(std::shared_ptr<rcl_node_t> node_handle, std::shared_ptr<rcl_service_t> service_handle,
          AnyServiceCallback<ServiceT> any_callback)
      : ServiceBase(std::move(node_handle), std::move(service_handle),
                    *rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>()),
        any_callback_(std::move(any_callback)) {
    trace_creation(any_callback_);
  }
  // The same with a service that stays the caller's, and must outlive this object.
  Service(std::shared_ptr<rcl_node_t> node_handle, rcl_service_t* service_handle,
          AnyServiceCallback<ServiceT> any_callback)
      : Service(std::move(node_handle), std::shared_ptr<rcl_service_t>(service_handle, [](rcl_service_t*) {}),
                std::move(any_callback)) {}

  // Executors call these.
  std::shared_ptr<void> create_request() override { return std::make_shared<Request>(); }

  void handle_request(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> request) override {
    const std::shared_ptr<Response> response = any_callback_.dispatch(
        this->shared_from_this(), request_header, std::static_pointer_cast<Request>(std::move(request)));
    if (response) {
      send_response(*request_header, *response);
    }
  }

 private:
  AnyServiceCallback<ServiceT> any_callback_;
};

}  // namespace rclcpp
