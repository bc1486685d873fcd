// Publishers for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/publisher.hpp"

namespace rclcpp {

// `node` is a Node, a pointer to one, or the like. Throws exceptions::InvalidTopicNameError,
// exceptions::InvalidQosOverridesException, exceptions::RCLError, and what the constructor of PublisherT throws.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>, typename NodeT>
std::shared_ptr<PublisherT> create_publisher(
    NodeT&& node, const std::string& topic_name, const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options = PublisherOptionsWithAllocator<AllocatorT>()) {
  const auto node_base = node_interfaces::dereferenced(node).get_node_base_interface();
  QoS actual_qos = qos;
  if (!options.qos_overriding_options.get_policy_kinds().empty()) {
    actual_qos = detail::declare_qos_parameters(
        options.qos_overriding_options, *node_interfaces::dereferenced(node).get_node_parameters_interface(),
        node_base->resolve_topic_or_service_name(topic_name, false), qos, detail::QosEntity::Publisher);
  }
  auto publisher = std::make_shared<PublisherT>(node_base.get(), topic_name, actual_qos, options);
  publisher->post_init_setup(node_base.get(), topic_name, actual_qos, options);
  node_interfaces::dereferenced(node).get_node_topics_interface()->add_publisher(publisher, options.callback_group);
  return publisher;
}

}  // namespace rclcpp
