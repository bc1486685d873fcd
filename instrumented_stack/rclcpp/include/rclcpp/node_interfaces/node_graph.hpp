// What a node knows of the whole system: other nodes, topics, how many publish and subscribe.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"

namespace rclcpp::node_interfaces {

// Discovery takes time: what has just been created elsewhere may be missing. Throws exceptions::RCLError.
class NodeGraph {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeGraph)

  explicit NodeGraph(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Fully qualified names.
  std::vector<std::string> get_node_names() const;
  // Topic name to type names.
  std::map<std::string, std::vector<std::string>> get_topic_names_and_types(bool no_demangle = false) const;

  // The topic name is expanded and remapped as for a publisher of this node.
  size_t count_publishers(const std::string& topic_name) const;
  size_t count_subscribers(const std::string& topic_name) const;

  // Service name to type names.
  std::map<std::string, std::vector<std::string>> get_service_names_and_types() const;
  // The service name is expanded and remapped as for a client of this node.
  size_t count_services(const std::string& service_name) const;
  size_t count_clients(const std::string& service_name) const;

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeGraphInterface = NodeGraph;

}  // namespace rclcpp::node_interfaces
