// SPDX-License-Identifier: Apache-2.0
// Calls of a component container's services (composition_interfaces).
#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "programs/ros_client/parameter_messages.hpp"
#include "programs/ros_client/service_call.hpp"

namespace launch {

namespace {

namespace srv = composition_interfaces::srv;

std::string container_service(const std::string& container, const char* name) {
  return container + "/_container/" + name;
}

template <typename Response>
RosAnswer success_of(const Response& response) {
  RosAnswer answer;
  answer.ok = response.success;
  answer.error = response.error_message;
  return answer;
}

}  // namespace

std::unique_ptr<Operation> call(const LoadNode& request, rclcpp::Node& node, Operation::Answer answer) {
  auto message = std::make_shared<srv::LoadNode::Request>();
  message->package_name = request.node.package;
  message->plugin_name = request.node.plugin;
  message->node_name = request.node.name;
  message->node_namespace = request.node.name_space;
  for (const auto& [from, to] : request.node.remaps) {
    message->remap_rules.push_back(from + ":=" + to);
  }
  message->parameters = messages_of(request.node.parameters);
  message->extra_arguments = messages_of(request.node.extra_arguments);
  return std::make_unique<CallOperation<srv::LoadNode>>(
      std::move(answer), ServiceCall<srv::LoadNode>(node, container_service(request.container, "load_node"), message),
      [](const srv::LoadNode::Response& response) {
        RosAnswer result = success_of(response);
        result.node = response.full_node_name;
        result.unique_id = response.unique_id;
        return result;
      });
}

std::unique_ptr<Operation> call(const UnloadNode& request, rclcpp::Node& node, Operation::Answer answer) {
  auto message = std::make_shared<srv::UnloadNode::Request>();
  message->unique_id = request.unique_id;
  return std::make_unique<CallOperation<srv::UnloadNode>>(
      std::move(answer),
      ServiceCall<srv::UnloadNode>(node, container_service(request.container, "unload_node"), message),
      success_of<srv::UnloadNode::Response>);
}

std::unique_ptr<Operation> call(const ListNodes& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<CallOperation<srv::ListNodes>>(
      std::move(answer),
      ServiceCall<srv::ListNodes>(node, container_service(request.container, "list_nodes"),
                                  std::make_shared<srv::ListNodes::Request>()),
      [](const srv::ListNodes::Response& response) {
        RosAnswer result;
        result.ok = true;
        result.nodes = response.full_node_names;
        result.ids.assign(response.unique_ids.begin(), response.unique_ids.end());
        return result;
      });
}

}  // namespace launch
