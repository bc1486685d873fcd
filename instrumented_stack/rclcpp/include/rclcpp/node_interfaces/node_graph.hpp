// SPDX-License-Identifier: Apache-2.0
// The graph as a node of this stack sees it.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeGraph : public NodeGraphInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeGraph)

  explicit NodeGraph(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  std::vector<std::string> get_node_names() const override;
  std::vector<std::pair<std::string, std::string>> get_node_names_and_namespaces() const override;
  std::vector<std::tuple<std::string, std::string, std::string>> get_node_names_with_enclaves() const override;
  NamesAndTypes get_topic_names_and_types(bool no_demangle = false) const override;
  NamesAndTypes get_publisher_names_and_types_by_node(const std::string& node_name, const std::string& namespace_,
                                                      bool no_demangle = false) const override;
  NamesAndTypes get_subscriber_names_and_types_by_node(const std::string& node_name, const std::string& namespace_,
                                                       bool no_demangle = false) const override;
  NamesAndTypes get_service_names_and_types_by_node(const std::string& node_name,
                                                    const std::string& namespace_) const override;
  NamesAndTypes get_client_names_and_types_by_node(const std::string& node_name,
                                                   const std::string& namespace_) const override;
  size_t count_publishers(const std::string& topic_name) const override;
  size_t count_subscribers(const std::string& topic_name) const override;
  std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic_name,
                                                              bool no_mangle = false) const override;
  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic_name,
                                                                 bool no_mangle = false) const override;
  std::vector<ServiceEndpointInfo> get_clients_info_by_service(const std::string& service_name,
                                                               bool no_mangle = false) const override;
  std::vector<ServiceEndpointInfo> get_servers_info_by_service(const std::string& service_name,
                                                               bool no_mangle = false) const override;
  NamesAndTypes get_service_names_and_types() const override;
  size_t count_services(const std::string& service_name) const override;
  size_t count_clients(const std::string& service_name) const override;
  void notify_graph_change() override;
  void notify_shutdown() override;
  const rcl_guard_condition_t* get_graph_guard_condition() const override;
  Event::SharedPtr get_graph_event() override;
  void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) override;
  size_t count_graph_users() const override;

 private:
  NodeBaseInterface::SharedPtr node_base_;
  const std::shared_ptr<char> user_ = std::make_shared<char>();  // every graph event shares it
};

}  // namespace rclcpp::node_interfaces
