// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/generic_client.hpp"

#include <optional>

#include "rclcpp/create_generic_client.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/serialization.hpp"

namespace rclcpp {

GenericClient::GenericClient(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                             const std::string& service_type, const QoS& qos)
    : GenericClient(node_base, service_name, detail::find_service_type_support(service_type), qos) {}

GenericClient::GenericClient(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                             const rosidl_service_type_support_t* type_support, const QoS& qos)
    : ClientBase(node_base, *type_support, service_name, qos), type_support_(type_support) {}

GenericClient::SharedRequest GenericClient::create_request() {
  return detail::make_message(*type_support_->request_typesupport);
}

std::shared_ptr<void> GenericClient::create_response() {
  return detail::make_message(*type_support_->response_typesupport);
}

GenericClient::FutureAndRequestId GenericClient::async_send_request(const Request request) {
  Promise promise;
  Future future = promise.get_future();
  const int64_t request_id = send(request, std::move(promise));
  return {std::move(future), request_id};
}

GenericClient::SharedFutureAndRequestId GenericClient::async_send_request(const Request request,
                                                                          CallbackType callback) {
  Promise promise;
  SharedFuture future = promise.get_future().share();
  const int64_t request_id = send(request, WithCallback{std::move(callback), std::move(promise), future});
  return {std::move(future), request_id};
}

int64_t GenericClient::send(const void* request, Answer answer) {
  return pending_.add([&] { return send_type_erased_request(request); }, std::move(answer));
}

void GenericClient::handle_response(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> response) {
  std::optional<Answer> answer = pending_.take(request_header->sequence_number);
  if (!answer) {
    RCLCPP_DEBUG(get_logger("rclcpp"), "dropped a response of service '%s' to a request that is not pending",
                 get_service_name());
    return;
  }
  if (auto* promise = std::get_if<Promise>(&*answer)) {
    promise->set_value(std::move(response));
  } else {
    auto& with_callback = std::get<WithCallback>(*answer);
    with_callback.promise.set_value(std::move(response));
    with_callback.callback(std::move(with_callback.future));
  }
}

GenericClient::SharedPtr create_generic_client(std::shared_ptr<node_interfaces::NodeBaseInterface> node_base,
                                               std::shared_ptr<node_interfaces::NodeGraphInterface> /*node_graph*/,
                                               std::shared_ptr<node_interfaces::NodeServicesInterface> node_services,
                                               const std::string& service_name, const std::string& service_type,
                                               const QoS& qos, CallbackGroup::SharedPtr group) {
  auto client = std::make_shared<GenericClient>(node_base.get(), service_name, service_type, qos);
  node_services->add_client(client, group);
  return client;
}

}  // namespace rclcpp
