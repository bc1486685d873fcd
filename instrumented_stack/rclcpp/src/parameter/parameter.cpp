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

}  // namespace rclcpp
