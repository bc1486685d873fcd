// SPDX-License-Identifier: Apache-2.0
// Sends requests of one type to one service. Created by Node::create_client().
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <iterator>
#include <memory>
#include <optional>
#include <rosidl_typesupport_cpp/service_type_support.hpp>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "rclcpp/client_base.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/detail/pending_requests.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

namespace detail {

// The result of async_send_request(). It can be used like the future it holds.
template <typename FutureT>
struct FutureAndRequestId {
  FutureAndRequestId(FutureT future_, int64_t request_id_) : future(std::move(future_)), request_id(request_id_) {}

  auto get() { return future.get(); }
  bool valid() const noexcept { return future.valid(); }
  void wait() const { future.wait(); }
  template <typename RepT, typename RatioT>
  std::future_status wait_for(const std::chrono::duration<RepT, RatioT>& timeout) const {
    return future.wait_for(timeout);
  }
  template <typename ClockT, typename DurationT>
  std::future_status wait_until(const std::chrono::time_point<ClockT, DurationT>& time) const {
    return future.wait_until(time);
  }

  FutureT future;
  int64_t request_id;
};

}  // namespace detail

// Responses arrive only while an executor spins the node. Thread safe.
template <typename ServiceT>
class Client : public ClientBase {
 public:
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  using SharedRequest = std::shared_ptr<Request>;
  using SharedResponse = std::shared_ptr<Response>;
  using Promise = std::promise<SharedResponse>;
  using PromiseWithRequest = std::promise<std::pair<SharedRequest, SharedResponse>>;
  using SharedPromise = std::shared_ptr<Promise>;
  using SharedPromiseWithRequest = std::shared_ptr<PromiseWithRequest>;
  using Future = std::future<SharedResponse>;
  using SharedFuture = std::shared_future<SharedResponse>;
  using SharedFutureWithRequest = std::shared_future<std::pair<SharedRequest, SharedResponse>>;
  using CallbackType = std::function<void(SharedFuture)>;
  using CallbackWithRequestType = std::function<void(SharedFutureWithRequest)>;
  RCLCPP_SMART_PTR_DEFINITIONS(Client<ServiceT>)

  struct FutureAndRequestId : detail::FutureAndRequestId<Future> {
    using detail::FutureAndRequestId<Future>::FutureAndRequestId;
    SharedFuture share() { return this->future.share(); }
    // Before this struct the result was a SharedFuture; programs still use that name.
    operator SharedFuture() { return share(); }  // NOLINT
  };
  struct SharedFutureAndRequestId : detail::FutureAndRequestId<SharedFuture> {
    using detail::FutureAndRequestId<SharedFuture>::FutureAndRequestId;
  };
  struct SharedFutureWithRequestAndRequestId : detail::FutureAndRequestId<SharedFutureWithRequest> {
    using detail::FutureAndRequestId<SharedFutureWithRequest>::FutureAndRequestId;
  };

  Client(node_interfaces::NodeBaseInterface* node_base, const std::string& service_name, const QoS& qos)
      : ClientBase(node_base, *rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>(), service_name, qos) {
  }

  // A request without an answer stays pending until it is removed. Throw exceptions::RCLError.
  FutureAndRequestId async_send_request(SharedRequest request) {
    Promise promise;
    Future future = promise.get_future();
    const int64_t request_id = send(*request, std::move(promise));
    return FutureAndRequestId(std::move(future), request_id);
  }

  // The callback takes a SharedFuture or a SharedFutureWithRequest. The future has its value when the callback runs.
  template <typename CallbackT>
  auto async_send_request(SharedRequest request, CallbackT&& callback) {
    if constexpr (std::is_invocable_v<CallbackT&, SharedFuture>) {
      Promise promise;
      SharedFuture future = promise.get_future().share();
      const int64_t request_id =
          send(*request, WithCallback{std::forward<CallbackT>(callback), std::move(promise), future});
      return SharedFutureAndRequestId(std::move(future), request_id);
    } else {
      static_assert(std::is_invocable_v<CallbackT&, SharedFutureWithRequest>,
                    "the callback takes neither a SharedFuture nor a SharedFutureWithRequest");
      PromiseWithRequest promise;
      SharedFutureWithRequest future = promise.get_future().share();
      const int64_t request_id =
          send(*request, WithRequest{std::forward<CallbackT>(callback), request, std::move(promise), future});
      return SharedFutureWithRequestAndRequestId(std::move(future), request_id);
    }
  }

  // Returns true if the request was still pending. A response that comes later is dropped.
  bool remove_pending_request(int64_t request_id) { return pending_.remove(request_id); }
  bool remove_pending_request(const FutureAndRequestId& future) { return remove_pending_request(future.request_id); }
  bool remove_pending_request(const SharedFutureAndRequestId& future) {
    return remove_pending_request(future.request_id);
  }
  bool remove_pending_request(const SharedFutureWithRequestAndRequestId& future) {
    return remove_pending_request(future.request_id);
  }

  // Both return the number of requests that were removed; the second also gets their ids.
  size_t prune_pending_requests() { return pending_.prune(); }
  template <typename AllocatorT = std::allocator<int64_t>>
  size_t prune_requests_older_than(std::chrono::time_point<std::chrono::system_clock> time_point,
                                   std::vector<int64_t, AllocatorT>* pruned_requests = nullptr) {
    return pending_.prune_older_than(time_point, pruned_requests);
  }

  // Takes the next response without passing it on. Returns false if there is none.
  bool take_response(Response& response_out, rmw_request_id_t& request_header_out) {
    return take_type_erased_response(&response_out, request_header_out);
  }

  // Executors call these.
  std::shared_ptr<void> create_response() override { return std::make_shared<Response>(); }

  void handle_response(std::shared_ptr<rmw_request_id_t> request_header, std::shared_ptr<void> response) override {
    const SharedResponse typed = std::static_pointer_cast<Response>(std::move(response));
    std::optional<Answer> answer = pending_.take(request_header->sequence_number);
    if (!answer) {
      RCLCPP_DEBUG(get_logger("rclcpp"), "dropped a response of service '%s' to a request that is not pending",
                   get_service_name());
      return;
    }
    if (auto* promise = std::get_if<Promise>(&*answer)) {
      promise->set_value(typed);
    } else if (auto* with_callback = std::get_if<WithCallback>(&*answer)) {
      with_callback->promise.set_value(typed);
      with_callback->callback(std::move(with_callback->future));
    } else {
      auto& with_request = std::get<WithRequest>(*answer);
      with_request.promise.set_value({std::move(with_request.request), typed});
      with_request.callback(std::move(with_request.future));
    }
  }

 private:
  struct WithCallback {
    CallbackType callback;
    Promise promise;
    SharedFuture future;
  };
  struct WithRequest {
    CallbackWithRequestType callback;
    SharedRequest request;
    PromiseWithRequest promise;
    SharedFutureWithRequest future;
  };
  using Answer = std::variant<Promise, WithCallback, WithRequest>;

  int64_t send(const Request& request, Answer answer) {
    return pending_.add([&] { return send_type_erased_request(&request); }, std::move(answer));
  }

  detail::PendingRequests<Answer> pending_;
};

}  // namespace rclcpp
