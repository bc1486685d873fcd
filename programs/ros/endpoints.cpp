// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/endpoints.hpp"

#include <rcl/graph.h>

#include <rclcpp/exceptions.hpp>
#include <utility>

namespace launch {

namespace {

void require_ok(rcl_ret_t ret, const std::string& what) {
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace

DescribedPublisher::DescribedPublisher(GraphSession& session, const std::string& topic,
                                       std::shared_ptr<const MessageType> type, const rmw_qos_profile_t& qos)
    : session_(session), type_(std::move(type)) {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos;
  require_ok(rcl_publisher_init(&publisher_, &session_.rcl_node(), &type_.handle(), topic.c_str(), &options),
             "cannot publish on '" + topic + "'");
}

DescribedPublisher::~DescribedPublisher() {
  (void)rcl_publisher_fini(&publisher_, &session_.rcl_node());
}

void DescribedPublisher::publish(const MessageValue& value) {
  NativeMessage message(type_, value);
  require_ok(rcl_publish(&publisher_, message.data(), nullptr), "cannot publish");
}

std::size_t DescribedPublisher::subscription_count() const {
  std::size_t count = 0;
  require_ok(rcl_publisher_get_subscription_count(&publisher_, &count), "cannot count subscriptions");
  return count;
}

void DescribedPublisher::wait_for_all_acked(Seconds time) const {
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
  if (rcl_publisher_wait_for_all_acked(&publisher_, nanoseconds) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

RawSubscription::RawSubscription(GraphSession& session, const std::string& topic,
                                 std::shared_ptr<const MessageType> type, const rmw_qos_profile_t& qos)
    : session_(session), type_(std::move(type)) {
  rcl_subscription_options_t options = rcl_subscription_get_default_options();
  options.qos = qos;
  require_ok(rcl_subscription_init(&subscription_, &session_.rcl_node(), &type_.handle(), topic.c_str(), &options),
             "cannot subscribe to '" + topic + "'");
}

RawSubscription::~RawSubscription() {
  (void)rcl_subscription_fini(&subscription_, &session_.rcl_node());
}

std::optional<RawSubscription::Message> RawSubscription::take() {
  Message message;
  const rcl_ret_t ret =
      rcl_take_serialized_message(&subscription_, &message.bytes.get_rcl_serialized_message(), &message.info, nullptr);
  if (ret == RCL_RET_SUBSCRIPTION_TAKE_FAILED) {
    rcl_reset_error();
    return std::nullopt;
  }
  require_ok(ret, "cannot take a message");
  return message;
}

DescribedClient::DescribedClient(GraphSession& session, const std::string& service, const ServiceType& type,
                                 const rmw_qos_profile_t& qos)
    : session_(session), type_(type) {
  rcl_client_options_t options = rcl_client_get_default_options();
  options.qos = qos;
  require_ok(rcl_client_init(&client_, &session_.rcl_node(), &type_.handle(), service.c_str(), &options),
             "cannot call '" + service + "'");
}

DescribedClient::~DescribedClient() {
  (void)rcl_client_fini(&client_, &session_.rcl_node());
}

bool DescribedClient::service_is_ready() const {
  bool ready = false;
  require_ok(rcl_service_server_is_available(&session_.rcl_node(), &client_, &ready), "cannot look for the service");
  return ready;
}

std::int64_t DescribedClient::send(const MessageValue& request) {
  NativeMessage message(type_.request(), request);
  std::int64_t sent = 0;
  require_ok(rcl_send_request(&client_, message.data(), &sent), "cannot send the request");
  return sent;
}

std::optional<MessageValue> DescribedClient::take(std::int64_t sent) {
  while (true) {
    NativeMessage response(type_.response());
    rmw_request_id_t id{};
    const rcl_ret_t ret = rcl_take_response(&client_, &id, response.data());
    if (ret == RCL_RET_CLIENT_TAKE_FAILED) {
      rcl_reset_error();
      return std::nullopt;
    }
    require_ok(ret, "cannot take the response");
    if (id.sequence_number == sent) {
      return response.value();
    }
  }
}

std::optional<MessageValue> DescribedClient::call(const MessageValue& request, std::optional<Seconds> time) {
  const std::int64_t sent = send(request);
  const auto end = time ? SessionClock::now() + std::chrono::duration_cast<SessionClock::duration>(*time)
                        : SessionClock::time_point::max();
  while (true) {
    if (auto response = take(sent)) {
      return response;
    }
    if (GraphSession::is_stopped() || SessionClock::now() >= end) {
      return std::nullopt;
    }
    session_.wait({{}, {&client_}}, end);
  }
}

}  // namespace launch
