// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter.hpp"

namespace rclcpp {

Parameter Parameter::from_parameter_msg(const rcl_interfaces::msg::Parameter& parameter) {
  return Parameter(parameter.name, ParameterValue(parameter.value));
}

rcl_interfaces::msg::Parameter Parameter::to_parameter_msg() const {
  rcl_interfaces::msg::Parameter parameter;
  parameter.name = name_;
  parameter.value = value_.to_value_msg();
  return parameter;
}

std::string to_string(const Parameter& parameter) {
  return "{\"name\": \"" + parameter.get_name() + "\", \"type\": \"" + parameter.get_type_name() + "\", \"value\": \"" +
         parameter.value_to_string() + "\"}";
}

std::ostream& operator<<(std::ostream& stream, const Parameter& parameter) {
  return stream << to_string(parameter);
}

std::string _to_json_dict_entry(const Parameter& parameter) {
  return "\"" + parameter.get_name() + "\": {\"type\": \"" + parameter.get_type_name() + "\", \"value\": \"" +
         parameter.value_to_string() + "\"}";
}

std::string to_string(const std::vector<Parameter>& parameters) {
  std::string entries;
  for (const Parameter& parameter : parameters) {
    entries += (entries.empty() ? "" : ", ") + _to_json_dict_entry(parameter);
  }
  return "{" + entries + "}";
}

std::ostream& operator<<(std::ostream& stream, const std::vector<Parameter>& parameters) {
  return stream << rclcpp::to_string(parameters);
}

}  // namespace rclcpp
