// SPDX-License-Identifier: Apache-2.0
// A subscription to messages of any type, which are taken as bytes.
#pragma once

#include <rcl/subscription.h>

#include <memory>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>

namespace launch {

class OpaqueSubscription {
 public:
  struct Message {
    rclcpp::SerializedMessage bytes;  // with the encapsulation header
    rmw_message_info_t info{};
  };

  // `type` is "std_msgs/msg/String". The node must outlive the subscription. Throws rclcpp's exceptions, or
  // std::runtime_error if the middleware can't have the type.
  OpaqueSubscription(rclcpp::Node& node, const std::string& topic, const std::string& type, const rclcpp::QoS& qos);
  ~OpaqueSubscription();
  OpaqueSubscription(const OpaqueSubscription&) = delete;
  OpaqueSubscription& operator=(const OpaqueSubscription&) = delete;

  // The next message that has come.
  std::optional<Message> take();
  const rcl_subscription_t* handle() const { return &subscription_; }

 private:
  std::shared_ptr<rcl_node_t> node_;
  rcl_subscription_t subscription_ = rcl_get_zero_initialized_subscription();
};

}  // namespace launch
