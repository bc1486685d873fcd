// Publishers for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/publisher.hpp"

namespace rclcpp {

template <typename MessageT, typename NodeT>
typename Publisher<MessageT>::SharedPtr create_publisher(NodeT& node, const std::string& topic_name, const QoS& qos) {
  return std::make_shared<Publisher<MessageT>>(node.get_node_base_interface().get(), topic_name, qos);
}

}  // namespace rclcpp
