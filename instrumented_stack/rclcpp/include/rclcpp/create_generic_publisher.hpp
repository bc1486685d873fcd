// SPDX-License-Identifier: Apache-2.0
// Creates publishers whose type is given by name, for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/generic_publisher.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

// `topic_type` looks like "std_msgs/msg/String". Throws std::runtime_error if the type cannot be found, and what
// create_publisher() throws.
template <typename AllocatorT = std::allocator<void>>
std::shared_ptr<GenericPublisher> create_generic_publisher(
    const node_interfaces::NodeTopicsInterface::SharedPtr& topics, const std::string& topic_name,
    const std::string& topic_type, const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
  return std::make_shared<GenericPublisher>(topics->get_node_base_interface(),
                                            get_typesupport_library(topic_type, "rosidl_typesupport_cpp"), topic_name,
                                            topic_type, qos, options);
}

}  // namespace rclcpp
