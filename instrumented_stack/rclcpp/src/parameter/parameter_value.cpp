// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_value.hpp"

#include <ios>
#include <locale>
#include <sstream>

namespace rclcpp {

namespace {

template <typename T>
void write(std::ostream& stream, const T& value) {
  stream << value;
}
void write(std::ostream& stream, uint8_t value) {
  stream << "0x" << std::hex << static_cast<int>(value) << std::dec;
}
void write(std::ostream& stream, bool value) {
  stream << (value ? "true" : "false");
}

// Texts are the same in each locale: programs and people read them, and other nodes.
std::ostringstream plain_stream() {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  return stream;
}

std::string number(double value) {
  std::ostringstream stream = plain_stream();
  stream << std::fixed << value;
  return stream.str();
}

template <typename ContainerT>
std::string list(const ContainerT& values) {
  std::ostringstream stream = plain_stream();
  const char* separator = "";
  stream << "[";
  for (auto&& value : values) {
    stream << separator;
    write(stream, static_cast<const typename ContainerT::value_type&>(value));
    separator = ", ";
  }
  stream << "]";
  return stream.str();
}

}  // namespace

std::string to_string(ParameterType type) {
  switch (type) {
    case PARAMETER_NOT_SET:
      return "not set";
    case PARAMETER_BOOL:
      return "bool";
    case PARAMETER_INTEGER:
      return "integer";
    case PARAMETER_DOUBLE:
      return "double";
    case PARAMETER_STRING:
      return "string";
    case PARAMETER_BYTE_ARRAY:
      return "byte_array";
    case PARAMETER_BOOL_ARRAY:
      return "bool_array";
    case PARAMETER_INTEGER_ARRAY:
      return "integer_array";
    case PARAMETER_DOUBLE_ARRAY:
      return "double_array";
    case PARAMETER_STRING_ARRAY:
      return "string_array";
  }
  return "unknown type";
}

std::ostream& operator<<(std::ostream& stream, ParameterType type) {
  return stream << to_string(type);
}

std::string to_string(const ParameterValue& value) {
  const rcl_interfaces::msg::ParameterValue& message = value.to_value_msg();
  switch (value.get_type()) {
    case PARAMETER_BOOL:
      return message.bool_value ? "true" : "false";
    case PARAMETER_INTEGER:
      return std::to_string(message.integer_value);
    case PARAMETER_DOUBLE:
      return number(message.double_value);
    case PARAMETER_STRING:
      return message.string_value;
    case PARAMETER_BYTE_ARRAY:
      return list(message.byte_array_value);
    case PARAMETER_BOOL_ARRAY:
      return list(message.bool_array_value);
    case PARAMETER_INTEGER_ARRAY:
      return list(message.integer_array_value);
    case PARAMETER_DOUBLE_ARRAY:
      return list(message.double_array_value);
    case PARAMETER_STRING_ARRAY:
      return list(message.string_array_value);
    case PARAMETER_NOT_SET:
      break;
  }
  return to_string(value.get_type());
}

ParameterValue::ParameterValue(bool value) {
  value_.bool_value = value;
  value_.type = PARAMETER_BOOL;
}
ParameterValue::ParameterValue(int64_t value) {
  value_.integer_value = value;
  value_.type = PARAMETER_INTEGER;
}
ParameterValue::ParameterValue(double value) {
  value_.double_value = value;
  value_.type = PARAMETER_DOUBLE;
}
ParameterValue::ParameterValue(const std::string& value) {
  value_.string_value = value;
  value_.type = PARAMETER_STRING;
}
ParameterValue::ParameterValue(const std::vector<uint8_t>& value) {
  value_.byte_array_value = value;
  value_.type = PARAMETER_BYTE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<bool>& value) {
  value_.bool_array_value = value;
  value_.type = PARAMETER_BOOL_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<int>& value) {
  value_.integer_array_value.assign(value.begin(), value.end());
  value_.type = PARAMETER_INTEGER_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<int64_t>& value) {
  value_.integer_array_value = value;
  value_.type = PARAMETER_INTEGER_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<float>& value) {
  value_.double_array_value.assign(value.begin(), value.end());
  value_.type = PARAMETER_DOUBLE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<double>& value) {
  value_.double_array_value = value;
  value_.type = PARAMETER_DOUBLE_ARRAY;
}
ParameterValue::ParameterValue(const std::vector<std::string>& value) {
  value_.string_array_value = value;
  value_.type = PARAMETER_STRING_ARRAY;
}

void ParameterValue::require(ParameterType type) const {
  if (get_type() != type) {
    throw ParameterTypeException(type, get_type());
  }
}

}  // namespace rclcpp
