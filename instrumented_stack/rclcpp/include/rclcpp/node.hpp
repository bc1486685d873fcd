// SPDX-License-Identifier: Apache-2.0
// A node: a name in the graph, with publishers, subscriptions, services, timers and parameters. Derive from it or
// create it with std::make_shared, then give it to an executor or to rclcpp::spin(). detail/any_node.hpp has its
// functions.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/detail/any_node.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

class Node : public detail::AnyNode, public std::enable_shared_from_this<Node> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Node)

  // Names may be remapped by arguments. Throws exceptions::InvalidNodeNameError, exceptions::InvalidNamespaceError,
  // exceptions::UnknownROSArgsError, exceptions::RCLInvalidROSArgsError or exceptions::RCLError.
  explicit Node(const std::string& node_name, const NodeOptions& options = NodeOptions());
  Node(const std::string& node_name, const std::string& node_namespace, const NodeOptions& options = NodeOptions());
  ~Node() override;
  RCLCPP_DISABLE_COPY(Node)

  // Creates a node that others see as this one. The relative names of its entities are in a sub-namespace. Throws
  // exceptions::NameValidationError if the sub-namespace is empty or begins with a slash, and
  // exceptions::InvalidNamespaceError.
  std::shared_ptr<Node> create_sub_node(const std::string& sub_namespace);

 protected:
  Node(Node& other, const std::string& sub_namespace);

 private:
  std::shared_ptr<Node> parent_;  // set for a sub-node
};

}  // namespace rclcpp
