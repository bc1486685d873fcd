// SPDX-License-Identifier: Apache-2.0
#include "programs/ros_client/parameter_messages.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <string>
#include <variant>

namespace launch {

namespace {

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

}  // namespace

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

}  // namespace launch
