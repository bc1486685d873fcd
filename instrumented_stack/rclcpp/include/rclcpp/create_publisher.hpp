// Publishers for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/publisher.hpp"

namespace rclcpp {

template <typename MessageT, typename NodeT>
typename Publisher<MessageT>::SharedPtr create_publisher(NodeT& node, const std::string& topic_name, const QoS& qos,
                                                         const PublisherOptions& options = PublisherOptions()) {
  auto publisher =
      std::make_shared<Publisher<MessageT>>(node.get_node_base_interface().get(), topic_name, qos, options);
  node.get_node_topics_interface()->add_publisher(publisher, options.callback_group);
  return publisher;
}

}  // namespace rclcpp
