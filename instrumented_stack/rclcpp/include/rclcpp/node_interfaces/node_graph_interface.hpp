// SPDX-License-Identifier: Apache-2.0
// The graph as a node sees it: other nodes, topics, numbers of publishers and subscriptions.
#pragma once

#include <rcl/guard_condition.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rclcpp/event.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/service_endpoint_info.hpp"
#include "rclcpp/topic_endpoint_info.hpp"

namespace rclcpp::node_interfaces {

// Discovery takes time: entities created elsewhere just now may be missing. Throws exceptions::RCLError.
class NodeGraphInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeGraphInterface)
  virtual ~NodeGraphInterface() = default;

  // Name to type names, of topics or services.
  using NamesAndTypes = std::map<std::string, std::vector<std::string>>;

  // Fully qualified names.
  virtual std::vector<std::string> get_node_names() const = 0;
  virtual std::vector<std::pair<std::string, std::string>> get_node_names_and_namespaces() const = 0;
  // Names, namespaces and enclaves. Nodes without security are in the enclave "/".
  virtual std::vector<std::tuple<std::string, std::string, std::string>> get_node_names_with_enclaves() const = 0;
  virtual NamesAndTypes get_topic_names_and_types(bool no_demangle = false) const = 0;

  // The entities of one node. Throw exceptions::RCLError with RCL_RET_NODE_NAME_NON_EXISTENT if no such node is known.
  virtual NamesAndTypes get_publisher_names_and_types_by_node(const std::string& node_name,
                                                              const std::string& namespace_,
                                                              bool no_demangle = false) const = 0;
  virtual NamesAndTypes get_subscriber_names_and_types_by_node(const std::string& node_name,
                                                               const std::string& namespace_,
                                                               bool no_demangle = false) const = 0;
  virtual NamesAndTypes get_service_names_and_types_by_node(const std::string& node_name,
                                                            const std::string& namespace_) const = 0;
  virtual NamesAndTypes get_client_names_and_types_by_node(const std::string& node_name,
                                                           const std::string& namespace_) const = 0;

  // The topic name is expanded and remapped as for a publisher of this node.
  virtual size_t count_publishers(const std::string& topic_name) const = 0;
  virtual size_t count_subscribers(const std::string& topic_name) const = 0;

  // The topic name is expanded and remapped, too. With `no_mangle` it is the name in DDS.
  virtual std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic_name,
                                                                      bool no_mangle = false) const = 0;
  virtual std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                         bool no_mangle = false) const = 0;

  // The service name is expanded and remapped as for a client of this node. With `no_mangle` types are those of DDS.
  virtual std::vector<ServiceEndpointInfo> get_clients_info_by_service(const std::string& service_name,
                                                                       bool no_mangle = false) const = 0;
  virtual std::vector<ServiceEndpointInfo> get_servers_info_by_service(const std::string& service_name,
                                                                       bool no_mangle = false) const = 0;

  virtual NamesAndTypes get_service_names_and_types() const = 0;
  // The service name is expanded and remapped as for a client of this node.
  virtual size_t count_services(const std::string& service_name) const = 0;
  virtual size_t count_clients(const std::string& service_name) const = 0;

  // Tells all that wait for the graph to look again. A change of the graph, and the end of the context, tell them
  // anyway. Throws exceptions::RCLError.
  virtual void notify_graph_change() = 0;
  virtual void notify_shutdown() = 0;
  // Triggered by every change of the graph.
  virtual const rcl_guard_condition_t* get_graph_guard_condition() const = 0;

  // An event that every later change of the graph sets.
  virtual Event::SharedPtr get_graph_event() = 0;
  // Returns when the event is set, the timeout is over (negative: never), or the context has ended. Throws
  // exceptions::InvalidEventError for null, exceptions::EventNotRegisteredError for an event that is not from
  // get_graph_event().
  virtual void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) = 0;
  // The number of events of get_graph_event() that are in use.
  virtual size_t count_graph_users() const = 0;
};

}  // namespace rclcpp::node_interfaces
