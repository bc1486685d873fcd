// SPDX-License-Identifier: Apache-2.0
// The graph as a node sees it: other nodes, topics, numbers of publishers and subscriptions.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/event.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/topic_endpoint_info.hpp"

namespace rclcpp::node_interfaces {

// Discovery takes time: entities created elsewhere just now may be missing. Throws exceptions::RCLError.
class NodeGraph {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeGraph)

  explicit NodeGraph(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Name to type names, of topics or services.
  using NamesAndTypes = std::map<std::string, std::vector<std::string>>;

  // Fully qualified names.
  std::vector<std::string> get_node_names() const;
  std::vector<std::pair<std::string, std::string>> get_node_names_and_namespaces() const;
  NamesAndTypes get_topic_names_and_types(bool no_demangle = false) const;

  // The entities of one node. Throw exceptions::RCLError with RCL_RET_NODE_NAME_NON_EXISTENT if no such node is known.
  NamesAndTypes get_publisher_names_and_types_by_node(const std::string& node_name, const std::string& namespace_,
                                                      bool no_demangle = false) const;
  NamesAndTypes get_subscriber_names_and_types_by_node(const std::string& node_name, const std::string& namespace_,
                                                       bool no_demangle = false) const;
  NamesAndTypes get_service_names_and_types_by_node(const std::string& node_name, const std::string& namespace_) const;
  NamesAndTypes get_client_names_and_types_by_node(const std::string& node_name, const std::string& namespace_) const;

  // The topic name is expanded and remapped as for a publisher of this node.
  size_t count_publishers(const std::string& topic_name) const;
  size_t count_subscribers(const std::string& topic_name) const;

  // The topic name is expanded and remapped, too. With `no_mangle` it is the name in DDS.
  std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic_name,
                                                              bool no_mangle = false) const;
  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                 bool no_mangle = false) const;

  NamesAndTypes get_service_names_and_types() const;
  // The service name is expanded and remapped as for a client of this node.
  size_t count_services(const std::string& service_name) const;
  size_t count_clients(const std::string& service_name) const;

  // An event that every later change of the graph sets.
  Event::SharedPtr get_graph_event() const;
  // Returns when the event is set, the timeout is over (negative: never), or the context has ended. Throws
  // exceptions::InvalidEventError for null.
  void wait_for_graph_change(const Event::SharedPtr& event, std::chrono::nanoseconds timeout) const;

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeGraphInterface = NodeGraph;

}  // namespace rclcpp::node_interfaces
