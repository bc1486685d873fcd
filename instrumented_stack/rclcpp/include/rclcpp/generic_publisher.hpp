// SPDX-License-Identifier: Apache-2.0
// Sends messages as bytes; their type is known only by name, at run time. Created by Node::create_generic_publisher().
#pragma once

#include <memory>
#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/publisher_factory.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_options.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

// Publishing is thread safe.
class GenericPublisher : public PublisherBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericPublisher)

  // `library` is the type support library of `topic_type`; see get_typesupport_library().
  template <typename AllocatorT = std::allocator<void>>
  GenericPublisher(
      node_interfaces::NodeBaseInterface* node_base, const std::shared_ptr<SharedLibrary>& library,
      const std::string& topic_name, const std::string& topic_type, const QoS& qos,
      const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>())
      : PublisherBase(node_base, topic_name,
                      *get_message_typesupport_handle(topic_type, "rosidl_typesupport_cpp", *library), qos, options),
        type_support_(get_message_typesupport_handle(topic_type, "rosidl_typesupport_cpp", *library)) {}

  // Publishes the bytes of a message: the encapsulation header, then CDR.
  void publish(const SerializedMessage& message);

  // The same in memory of the middleware. Throws exceptions::RCLError if the type cannot be loaned.
  void publish_as_loaned_msg(const SerializedMessage& message);

 private:
  const rosidl_message_type_support_t* type_support_;
};

}  // namespace rclcpp
