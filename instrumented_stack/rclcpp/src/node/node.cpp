// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/node.hpp"

namespace rclcpp {

Node::Node(const std::string& node_name, const NodeOptions& options) : Node(node_name, "", options) {}

Node::Node(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options)
    : AnyNode(node_name, node_namespace, options) {}

Node::Node(Node& other, const std::string& sub_namespace)
    : AnyNode(other, sub_namespace), parent_(other.shared_from_this()) {}

Node::~Node() = default;

std::shared_ptr<Node> Node::create_sub_node(const std::string& sub_namespace) {
  // std::make_shared cannot call the protected constructor.
  return std::shared_ptr<Node>(new Node(*this, sub_namespace));
}

}  // namespace rclcpp
