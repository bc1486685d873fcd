// SPDX-License-Identifier: Apache-2.0
// The factory of any class that is constructed from rclcpp::NodeOptions and has get_node_base_interface(). It need not
// derive from rclcpp::Node.
#pragma once

#include <memory>

#include "rclcpp_components/node_factory.hpp"

namespace rclcpp_components {

template <typename NodeT>
class NodeFactoryTemplate : public NodeFactory {
 public:
  NodeInstanceWrapper create_node_instance(const rclcpp::NodeOptions& options) override {
    return NodeInstanceWrapper(std::make_shared<NodeT>(options), [](const std::shared_ptr<void>& instance) {
      return std::static_pointer_cast<NodeT>(instance)->get_node_base_interface();
    });
  }
};

}  // namespace rclcpp_components
