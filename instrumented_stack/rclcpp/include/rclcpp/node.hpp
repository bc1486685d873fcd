// SPDX-License-Identifier: Apache-2.0
// A node: a name in the graph, with publishers, subscriptions, services, timers and parameters. Derive from it or
// create it with std::make_shared, then give it to an executor or to rclcpp::spin(). detail/any_node.hpp has its
// functions.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <unordered_set>

#include "rclcpp/detail/any_node.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/get_message_type_support_handle.hpp"
#include "rclcpp/is_ros_compatible_type.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/get_node_services_interface.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp/rate.hpp"
#include "rclcpp/serialization.hpp"
#include "rclcpp/subscription_content_filter_options.hpp"
#include "rclcpp/subscription_traits.hpp"
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
