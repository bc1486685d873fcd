// SPDX-License-Identifier: Apache-2.0
// A parameter's value: one of nine types, or not set.
#pragma once

#include <cstdint>
#include <ostream>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <rcl_interfaces/msg/parameter_value.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace rclcpp {

enum ParameterType : uint8_t {
  PARAMETER_NOT_SET = rcl_interfaces::msg::ParameterType::PARAMETER_NOT_SET,
  PARAMETER_BOOL = rcl_interfaces::msg::ParameterType::PARAMETER_BOOL,
  PARAMETER_INTEGER = rcl_interfaces::msg::ParameterType::PARAMETER_INTEGER,
  PARAMETER_DOUBLE = rcl_interfaces::msg::ParameterType::PARAMETER_DOUBLE,
  PARAMETER_STRING = rcl_interfaces::msg::ParameterType::PARAMETER_STRING,
  PARAMETER_BYTE_ARRAY = rcl_interfaces::msg::ParameterType::PARAMETER_BYTE_ARRAY,
  PARAMETER_BOOL_ARRAY = rcl_interfaces::msg::ParameterType::PARAMETER_BOOL_ARRAY,
  PARAMETER_INTEGER_ARRAY = rcl_interfaces::msg::ParameterType::PARAMETER_INTEGER_ARRAY,
  PARAMETER_DOUBLE_ARRAY = rcl_interfaces::msg::ParameterType::PARAMETER_DOUBLE_ARRAY,
  PARAMETER_STRING_ARRAY = rcl_interfaces::msg::ParameterType::PARAMETER_STRING_ARRAY,
};

// "integer", "double_array" and so on.
std::string to_string(ParameterType type);
std::ostream& operator<<(std::ostream& stream, ParameterType type);

// A value was read as a type that it does not have.
class ParameterTypeException : public std::runtime_error {
 public:
  ParameterTypeException(ParameterType expected, ParameterType actual)
      : std::runtime_error("expected [" + to_string(expected) + "] got [" + to_string(actual) + "]") {}
};

class ParameterValue {
 public:
  ParameterValue() = default;  // not set
  explicit ParameterValue(const rcl_interfaces::msg::ParameterValue& value) : value_(value) {}
  explicit ParameterValue(bool value);
  explicit ParameterValue(int value) : ParameterValue(static_cast<int64_t>(value)) {}
  explicit ParameterValue(int64_t value);
  explicit ParameterValue(float value) : ParameterValue(static_cast<double>(value)) {}
  explicit ParameterValue(double value);
  explicit ParameterValue(const std::string& value);
  explicit ParameterValue(const char* value) : ParameterValue(std::string(value)) {}
  explicit ParameterValue(const std::vector<uint8_t>& value);
  explicit ParameterValue(const std::vector<bool>& value);
  explicit ParameterValue(const std::vector<int>& value);
  explicit ParameterValue(const std::vector<int64_t>& value);
  explicit ParameterValue(const std::vector<float>& value);
  explicit ParameterValue(const std::vector<double>& value);
  explicit ParameterValue(const std::vector<std::string>& value);

  ParameterType get_type() const { return static_cast<ParameterType>(value_.type); }
  const rcl_interfaces::msg::ParameterValue& to_value_msg() const { return value_; }

  bool operator==(const ParameterValue& other) const { return value_ == other.value_; }
  bool operator!=(const ParameterValue& other) const { return !(*this == other); }

  // Gets the value by parameter type: get<PARAMETER_INTEGER>(). Throws ParameterTypeException.
  template <ParameterType type>
  const auto& get() const {
    require(type);
    if constexpr (type == PARAMETER_BOOL) {
      return value_.bool_value;
    } else if constexpr (type == PARAMETER_INTEGER) {
      return value_.integer_value;
    } else if constexpr (type == PARAMETER_DOUBLE) {
      return value_.double_value;
    } else if constexpr (type == PARAMETER_STRING) {
      return value_.string_value;
    } else if constexpr (type == PARAMETER_BYTE_ARRAY) {
      return value_.byte_array_value;
    } else if constexpr (type == PARAMETER_BOOL_ARRAY) {
      return value_.bool_array_value;
    } else if constexpr (type == PARAMETER_INTEGER_ARRAY) {
      return value_.integer_array_value;
    } else if constexpr (type == PARAMETER_DOUBLE_ARRAY) {
      return value_.double_array_value;
    } else {
      static_assert(type == PARAMETER_STRING_ARRAY, "a parameter that is not set has no value");
      return value_.string_array_value;
    }
  }

  // Gets the value by C++ type: get<int>(). Throws ParameterTypeException. Integers and doubles are not converted into
  // each other.
  template <typename T>
  auto get() const {
    if constexpr (std::is_same_v<T, bool>) {
      return get<PARAMETER_BOOL>();
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(get<PARAMETER_INTEGER>());
    } else if constexpr (std::is_floating_point_v<T>) {
      return static_cast<T>(get<PARAMETER_DOUBLE>());
    } else if constexpr (std::is_convertible_v<T, std::string>) {
      return get<PARAMETER_STRING>();
    } else if constexpr (std::is_same_v<T, std::vector<uint8_t>>) {
      return get<PARAMETER_BYTE_ARRAY>();
    } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
      return get<PARAMETER_BOOL_ARRAY>();
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
      return get<PARAMETER_STRING_ARRAY>();
    } else if constexpr (std::is_same_v<T, std::vector<int>> || std::is_same_v<T, std::vector<int64_t>>) {
      const auto& values = get<PARAMETER_INTEGER_ARRAY>();
      return T(values.begin(), values.end());
    } else {
      static_assert(std::is_same_v<T, std::vector<float>> || std::is_same_v<T, std::vector<double>>,
                    "parameters cannot have this type");
      const auto& values = get<PARAMETER_DOUBLE_ARRAY>();
      return T(values.begin(), values.end());
    }
  }

 private:
  void require(ParameterType type) const;

  rcl_interfaces::msg::ParameterValue value_;
};

// Readable text: `[1, 2]`, `true`, `not set`.
std::string to_string(const ParameterValue& value);

}  // namespace rclcpp
