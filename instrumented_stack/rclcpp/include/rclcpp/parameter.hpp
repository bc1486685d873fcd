// SPDX-License-Identifier: Apache-2.0
// A parameter: a name and its value.
#pragma once

#include <cstdint>
#include <ostream>
#include <rcl_interfaces/msg/parameter.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/parameter_value.hpp"

namespace rclcpp {

class Parameter {
 public:
  Parameter() = default;
  explicit Parameter(std::string name) : name_(std::move(name)) {}  // not set
  Parameter(std::string name, ParameterValue value) : name_(std::move(name)), value_(std::move(value)) {}
  template <typename ValueT>
  Parameter(std::string name, const ValueT& value) : Parameter(std::move(name), ParameterValue(value)) {}

  static Parameter from_parameter_msg(const rcl_interfaces::msg::Parameter& parameter);
  rcl_interfaces::msg::Parameter to_parameter_msg() const;

  const std::string& get_name() const { return name_; }
  ParameterType get_type() const { return value_.get_type(); }
  std::string get_type_name() const { return to_string(get_type()); }
  const ParameterValue& get_parameter_value() const { return value_; }
  rcl_interfaces::msg::ParameterValue get_value_message() const { return value_.to_value_msg(); }

  // The value as a C++ type. Throws exceptions::InvalidParameterTypeException, which names the parameter. As a
  // ParameterValue it is the value of any type, as a Parameter the parameter itself; both are valid as long as this.
  template <typename T>
  decltype(auto) get_value() const {
    try {
      if constexpr (std::is_same_v<T, ParameterValue>) {
        return (value_);
      } else if constexpr (std::is_same_v<T, Parameter>) {
        return (*this);
      } else {
        return value_.get<T>();
      }
    } catch (const ParameterTypeException& error) {
      throw exceptions::InvalidParameterTypeException(name_, error.what());
    }
  }
  // The value as a parameter type, like the functions below. Throw ParameterTypeException.
  template <ParameterType type>
  auto get_value() const {
    return value_.get<type>();
  }
  bool as_bool() const { return get_value<PARAMETER_BOOL>(); }
  int64_t as_int() const { return get_value<PARAMETER_INTEGER>(); }
  double as_double() const { return get_value<PARAMETER_DOUBLE>(); }
  std::string as_string() const { return get_value<PARAMETER_STRING>(); }
  std::vector<uint8_t> as_byte_array() const { return get_value<PARAMETER_BYTE_ARRAY>(); }
  std::vector<bool> as_bool_array() const { return get_value<PARAMETER_BOOL_ARRAY>(); }
  std::vector<int64_t> as_integer_array() const { return get_value<PARAMETER_INTEGER_ARRAY>(); }
  std::vector<double> as_double_array() const { return get_value<PARAMETER_DOUBLE_ARRAY>(); }
  std::vector<std::string> as_string_array() const { return get_value<PARAMETER_STRING_ARRAY>(); }

  std::string value_to_string() const { return to_string(value_); }

  bool operator==(const Parameter& other) const { return name_ == other.name_ && value_ == other.value_; }
  bool operator!=(const Parameter& other) const { return !(*this == other); }

 private:
  std::string name_;
  ParameterValue value_;
};

// Returns JSON: {"name": "speed", "type": "double", "value": "1.500000"}.
std::string to_string(const Parameter& parameter);
std::ostream& operator<<(std::ostream& stream, const Parameter& parameter);
// Returns JSON: {"speed": {"type": "double", "value": "1.500000"}, …}.
std::string to_string(const std::vector<Parameter>& parameters);
std::ostream& operator<<(std::ostream& stream, const std::vector<Parameter>& parameters);
// One of these entries.
std::string _to_json_dict_entry(const Parameter& parameter);  // NOLINT: rclcpp's name

}  // namespace rclcpp

// rclcpp has these functions here, and programs call them so.
namespace std {

inline string to_string(const rclcpp::Parameter& parameter) {  // NOLINT
  return rclcpp::to_string(parameter);
}
inline string to_string(const vector<rclcpp::Parameter>& parameters) {  // NOLINT
  return rclcpp::to_string(parameters);
}

}  // namespace std
