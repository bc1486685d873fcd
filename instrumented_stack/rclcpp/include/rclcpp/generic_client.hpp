// SPDX-License-Identifier: Apache-2.0
// Sends requests to a service whose type is known only by name, at run time. Created by Node::create_generic_client().
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rclcpp/client.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/detail/pending_requests.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

// Requests and responses are messages in memory, as for a Client of the type. Cast them, or read and write them as
// bytes with a SerializationBase. Responses arrive only while an executor spins the node. Thread safe.
class GenericClient : public ClientBase {
 public:
  using Request = void*;   // a message of the service's request type
  using Response = void*;  // a message of its response type
  using SharedRequest = std::shared_ptr<void>;
  using SharedResponse = std::shared_ptr<void>;
  using Promise = std::promise<SharedResponse>;
  using SharedPromise = std::shared_ptr<Promise>;
  using Future = std::future<SharedResponse>;
  using SharedFuture = std::shared_future<SharedResponse>;
  using CallbackType = std::function<void(SharedFuture)>;
  RCLCPP_SMART_PTR_DEFINITIONS(GenericClient)

  struct FutureAndRequestId : detail::FutureAndRequestId<Future> {
    using detail::FutureAndRequestId<Future>::FutureAndRequestId;
    SharedFuture share() { return this->future.share(); }
  };
  struct SharedFutureAndRequestId : detail::FutureAndRequestId<SharedFuture> {
    using detail::FutureAndRequestId<SharedFuture>::FutureAndRequestId;
  };

  // `service_type` looks like "std_srvs/srv/SetBool". Throws exceptions::InvalidServiceTypeError if the type cannot be
  // found, and what the constructor of ClientBase throws.
  GenericClient(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                const std::string& service_type, const QoS& qos = ServicesQoS());

  // A new request with the defaults of its type.
  SharedRequest create_request();
  std::shared_ptr<void> create_response() override;
  // The type support of the two messages, for a SerializationBase.
  const rosidl_service_type_support_t& get_service_type_support_handle() const { return *type_support_; }

  // A request without an answer stays pending until it is removed. Throw exceptions::RCLError.
  FutureAndRequestId async_send_request(const Request request);
  // The future has its value when the callback runs.
  SharedFutureAndRequestId async_send_request(const Request request, CallbackType callback);

  // Whether the request was pending.
  bool remove_pending_request(int64_t request_id) { return pending_.remove(request_id); }
  bool remove_pending_request(const FutureAndRequestId& future) { return remove_pending_request(future.request_id); }
  bool remove_pending_request(const SharedFutureAndRequestId& future) {
    return remove_pending_request(future.request_id);
  }
  // Both return the number of requests that were removed; the second also gets their ids.
  size_t prune_pending_requests() { return pending_.prune(); }
  size_t prune_requests_older_than(std::chrono::time_point<std::chrono::system_clock> time_point,
                                   std::vector<int64_t>* pruned_requests = nullptr) {
    return pending_.prune_older_than(time_point, pruned_requests);
  }

  // Takes the next response without passing it on. Returns false if there is none.
  bool take_response(Response response_out, rmw_request_id_t& request_header_out) {
    return take_type_erased_response(response_out, request_header_out);
  }

  // Executors call it.
  void handle_response(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> response) override;

 private:
  struct WithCallback {
    CallbackType callback;
    Promise promise;
    SharedFuture future;
  };
  using Answer = std::variant<Promise, WithCallback>;

  GenericClient(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name,
                const rosidl_service_type_support_t* type_support, const QoS& qos);
  int64_t send(const void* request, Answer answer);

  const rosidl_service_type_support_t* type_support_;
  detail::PendingRequests<Answer> pending_;
};

}  // namespace rclcpp
