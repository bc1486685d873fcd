// SPDX-License-Identifier: Apache-2.0
// Publishers, subscriptions and clients of messages that are known by their interface files.
#pragma once

#include <rcl/client.h>
#include <rcl/publisher.h>
#include <rcl/subscription.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <rclcpp/serialized_message.hpp>
#include <string>

#include "programs/ros/graph_session.hpp"
#include "programs/type_supports/described_type.hpp"

namespace launch {

// All throw rclcpp's exceptions, or std::runtime_error (described_type.hpp). The session must outlive them.
class DescribedPublisher {
 public:
  DescribedPublisher(GraphSession& session, const std::string& topic, std::shared_ptr<const MessageType> type,
                     const rmw_qos_profile_t& qos);
  ~DescribedPublisher();
  DescribedPublisher(const DescribedPublisher&) = delete;
  DescribedPublisher& operator=(const DescribedPublisher&) = delete;

  void publish(const MessageValue& value);
  std::size_t subscription_count() const;
  // Waits until all reliable subscriptions have everything, at most `time`.
  void wait_for_all_acked(Seconds time) const;

 private:
  GraphSession& session_;
  DescribedType type_;
  rcl_publisher_t publisher_ = rcl_get_zero_initialized_publisher();
};

class RawSubscription {
 public:
  struct Message {
    rclcpp::SerializedMessage bytes;  // with the encapsulation header
    rmw_message_info_t info{};
  };

  RawSubscription(GraphSession& session, const std::string& topic, std::shared_ptr<const MessageType> type,
                  const rmw_qos_profile_t& qos);
  ~RawSubscription();
  RawSubscription(const RawSubscription&) = delete;
  RawSubscription& operator=(const RawSubscription&) = delete;

  std::optional<Message> take();
  const rcl_subscription_t* handle() const { return &subscription_; }

 private:
  GraphSession& session_;
  DescribedType type_;
  rcl_subscription_t subscription_ = rcl_get_zero_initialized_subscription();
};

class DescribedClient {
 public:
  DescribedClient(GraphSession& session, const std::string& service, const ServiceType& type,
                  const rmw_qos_profile_t& qos = rmw_qos_profile_services_default);
  ~DescribedClient();
  DescribedClient(const DescribedClient&) = delete;
  DescribedClient& operator=(const DescribedClient&) = delete;

  bool service_is_ready() const;
  // Returns the number of the request, by which take() finds its response once it has come.
  std::int64_t send(const MessageValue& request);
  std::optional<MessageValue> take(std::int64_t sent);
  const rcl_client_t* handle() const { return &client_; }
  // Sends the request and waits for the response. None when `time` is over, or the user has asked to stop.
  std::optional<MessageValue> call(const MessageValue& request, std::optional<Seconds> time = std::nullopt);

 private:
  GraphSession& session_;
  DescribedService type_;
  rcl_client_t client_ = rcl_get_zero_initialized_client();
};

}  // namespace launch
