// SPDX-License-Identifier: Apache-2.0
// Sends requests to a container, as launch does.
#pragma once

#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/support/command.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

using composition_interfaces::srv::ListNodes;
using composition_interfaces::srv::LoadNode;
using composition_interfaces::srv::UnloadNode;

class ContainerClient {
 public:
  ContainerClient(rclcpp::Executor& executor, rclcpp::Node::SharedPtr node, std::string container)
      : executor_(executor), node_(std::move(node)), services_(std::move(container) + "/_container/") {}

  LoadNode::Response load(LoadNode::Request request) { return call<LoadNode>("load_node", std::move(request)); }
  LoadNode::Response load(const std::string& package, const std::string& plugin, const std::string& name = "") {
    LoadNode::Request request;
    request.package_name = package;
    request.plugin_name = plugin;
    request.node_name = name;
    return load(request);
  }
  UnloadNode::Response unload(uint64_t id) {
    UnloadNode::Request request;
    request.unique_id = id;
    return call<UnloadNode>("unload_node", request);
  }
  ListNodes::Response list() { return call<ListNodes>("list_nodes", ListNodes::Request()); }

 private:
  template <typename ServiceT>
  typename ServiceT::Response call(const std::string& service, typename ServiceT::Request request) {
    const auto client = node_->create_client<ServiceT>(services_ + service);
    if (!client->wait_for_service(kPatience)) {
      ADD_FAILURE() << services_ << service << " did not come";
      return typename ServiceT::Response();
    }
    auto future = client->async_send_request(std::make_shared<typename ServiceT::Request>(std::move(request)));
    if (executor_.spin_until_future_complete(future, kPatience) != rclcpp::FutureReturnCode::SUCCESS) {
      ADD_FAILURE() << services_ << service << " did not answer";
      return typename ServiceT::Response();
    }
    return *future.get();
  }

  rclcpp::Executor& executor_;
  rclcpp::Node::SharedPtr node_;
  const std::string services_;
};

template <typename ValueT>
rcl_interfaces::msg::Parameter parameter(const std::string& name, const ValueT& value) {
  return rclcpp::Parameter(name, value).to_parameter_msg();
}

// Writes the index entry of package `package`, as rclcpp_components_register_nodes() does, in `prefix`.
inline void write_components(const std::filesystem::path& prefix, const std::string& package, const std::string& text) {
  const auto folder = prefix / "share/ament_index/resource_index/rclcpp_components";
  std::filesystem::create_directories(folder);
  test_support::write_file(folder / package, text);
}
