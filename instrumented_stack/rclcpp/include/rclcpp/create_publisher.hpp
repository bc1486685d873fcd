// SPDX-License-Identifier: Apache-2.0
// Creates publishers for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/node_interfaces/get_node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/get_node_topics_interface.hpp"
#include "rclcpp/publisher.hpp"

namespace rclcpp {

// `node_parameters` may be null if no policy can be overridden. Throws exceptions::InvalidTopicNameError,
// exceptions::InvalidQosOverridesException, exceptions::RCLError, and what the constructor of PublisherT throws.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>>
std::shared_ptr<PublisherT> create_publisher(
    const std::shared_ptr<node_interfaces::NodeParametersInterface>& node_parameters,
    const std::shared_ptr<node_interfaces::NodeTopicsInterface>& node_topics, const std::string& topic_name,
    const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
  const QoS actual_qos =
      detail::overridden_qos(options.qos_overriding_options, node_parameters, *node_topics->get_node_base_interface(),
                             topic_name, qos, detail::QosEntity::Publisher);
  const auto publisher = node_topics->create_publisher(
      topic_name, create_publisher_factory<MessageT, AllocatorT, PublisherT>(options), actual_qos);
  node_topics->add_publisher(publisher, options.callback_group);
  return std::dynamic_pointer_cast<PublisherT>(publisher);
}

// `node` is a Node, a pointer to one, a similar class, or only its topics interface.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>, typename NodeT>
std::shared_ptr<PublisherT> create_publisher(
    NodeT&& node, const std::string& topic_name, const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
  return create_publisher<MessageT, AllocatorT, PublisherT>(node_interfaces::find_node_parameters_interface(node),
                                                            node_interfaces::get_node_topics_interface(node),
                                                            topic_name, qos, options);
}

}  // namespace rclcpp
