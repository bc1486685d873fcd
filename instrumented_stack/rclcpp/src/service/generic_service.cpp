// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/generic_service.hpp"

#include "rclcpp/serialization.hpp"

namespace rclcpp {

GenericServiceCallback::SharedResponse GenericServiceCallback::dispatch(const ServicePtr& service, const Header& header,
                                                                        SharedRequest request) {
  trace_start();
  SharedResponse response = answer_(service, header, std::move(request));
  trace_end();
  return response;
}

GenericServiceCallback::SharedResponse GenericServiceCallback::response_of(const ServicePtr& service) {
  return service->create_response();
}

GenericService::GenericService(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                               const std::string& service_type, GenericServiceCallback any_callback, const QoS& qos)
    : GenericService(node_base, service_name, detail::find_service_type_support(service_type), std::move(any_callback),
                     qos) {}

GenericService::GenericService(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                               const rosidl_service_type_support_t* type_support, GenericServiceCallback any_callback,
                               const QoS& qos)
    : ServiceBase(node_base, *type_support, service_name, qos),
      type_support_(type_support),
      any_callback_(std::move(any_callback)) {
  trace_creation(any_callback_);
}

std::shared_ptr<void> GenericService::create_request() {
  return detail::make_message(*type_support_->request_typesupport);
}

GenericService::SharedResponse GenericService::create_response() {
  return detail::make_message(*type_support_->response_typesupport);
}

void GenericService::handle_request(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> request) {
  SharedResponse response = any_callback_.dispatch(shared_from_this(), request_header, std::move(request));
  if (response) {
    send_response(*request_header, response);
  }
}

}  // namespace rclcpp
