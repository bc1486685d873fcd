// SPDX-License-Identifier: Apache-2.0
// Calls of a component container's services (composition_interfaces).
#include <algorithm>
#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <cstdint>
#include <rcl_interfaces/msg/parameter.hpp>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <string>
#include <vector>

#include "programs/ros_client/service_call.hpp"

namespace launch {

namespace {

namespace srv = composition_interfaces::srv;
using rcl_interfaces::msg::ParameterType;

template <typename Item>
std::vector<Item> items_of(const std::vector<ParameterScalar>& scalars) {
  std::vector<Item> items;
  for (const ParameterScalar& scalar : scalars) {
    items.push_back(std::get<Item>(scalar));
  }
  return items;
}

struct SetValue {
  rcl_interfaces::msg::ParameterValue& message;

  void operator()(bool value) const {
    message.type = ParameterType::PARAMETER_BOOL;
    message.bool_value = value;
  }
  void operator()(std::int64_t value) const {
    message.type = ParameterType::PARAMETER_INTEGER;
    message.integer_value = value;
  }
  void operator()(double value) const {
    message.type = ParameterType::PARAMETER_DOUBLE;
    message.double_value = value;
  }
  void operator()(const std::string& value) const {
    message.type = ParameterType::PARAMETER_STRING;
    message.string_value = value;
  }
  void operator()(std::byte value) const {
    message.type = ParameterType::PARAMETER_BYTE_ARRAY;
    message.byte_array_value = {std::to_integer<std::uint8_t>(value)};
  }
  void operator()(const ParameterScalar& value) const { std::visit(*this, value); }
  // All items have one type. A list without items is sent as ros2 launch sends it.
  void operator()(const std::vector<ParameterScalar>& list) const {
    if (list.empty()) {
      message.type = ParameterType::PARAMETER_BYTE_ARRAY;
    } else if (std::holds_alternative<bool>(list.front())) {
      message.type = ParameterType::PARAMETER_BOOL_ARRAY;
      message.bool_array_value = items_of<bool>(list);
    } else if (std::holds_alternative<std::int64_t>(list.front())) {
      message.type = ParameterType::PARAMETER_INTEGER_ARRAY;
      message.integer_array_value = items_of<std::int64_t>(list);
    } else if (std::holds_alternative<double>(list.front())) {
      message.type = ParameterType::PARAMETER_DOUBLE_ARRAY;
      message.double_array_value = items_of<double>(list);
    } else if (std::holds_alternative<std::byte>(list.front())) {
      message.type = ParameterType::PARAMETER_BYTE_ARRAY;
      for (const std::byte byte : items_of<std::byte>(list)) {
        message.byte_array_value.push_back(std::to_integer<std::uint8_t>(byte));
      }
    } else {
      message.type = ParameterType::PARAMETER_STRING_ARRAY;
      message.string_array_value = items_of<std::string>(list);
    }
  }
};

// Only the last parameter of each name is sent, because a container would refuse a name that comes twice.
std::vector<rcl_interfaces::msg::Parameter> messages_of(const std::vector<NamedParameter>& parameters) {
  std::vector<rcl_interfaces::msg::Parameter> messages;
  for (const NamedParameter& parameter : parameters) {
    auto message = std::find_if(messages.begin(), messages.end(),
                                [&](const auto& earlier) { return earlier.name == parameter.name; });
    if (message == messages.end()) {
      message = messages.emplace(message);
    }
    *message = rcl_interfaces::msg::Parameter();
    message->name = parameter.name;
    std::visit(SetValue{message->value}, parameter.value);
  }
  return messages;
}

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
