// Sends messages of one type on one topic. Created by Node::create_publisher().
#pragma once

#include <memory>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <string>

#include "rclcpp/publisher_base.hpp"

namespace rclcpp {

// Publishing is thread safe.
template <typename MessageT>
class Publisher : public PublisherBase {
 public:
  using ROSMessageType = MessageT;
  RCLCPP_SMART_PTR_DEFINITIONS(Publisher<MessageT>)

  Publisher(node_interfaces::NodeBaseInterface* node_base, const std::string& topic, const QoS& qos,
            const PublisherOptionsBase& options = PublisherOptionsBase())
      : PublisherBase(node_base, topic, *rosidl_typesupport_cpp::get_message_type_support_handle<MessageT>(), qos,
                      options) {}

  virtual void publish(const MessageT& message) { publish_message(&message); }
  virtual void publish(std::unique_ptr<MessageT> message) { publish_message(message.get()); }
  void publish(const SerializedMessage& message) { publish_serialized(message.get_rcl_serialized_message()); }
  void publish(const rcl_serialized_message_t& message) { publish_serialized(message); }
};

}  // namespace rclcpp
