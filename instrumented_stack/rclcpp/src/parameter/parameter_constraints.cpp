// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "parameter/parameter_changes.hpp"

namespace rclcpp {

namespace {

using rcl_interfaces::msg::ParameterDescriptor;
using rcl_interfaces::msg::SetParametersResult;

SetParametersResult success() {
  SetParametersResult result;
  result.successful = true;
  return result;
}

SetParametersResult failure(std::string reason) {
  SetParametersResult result;
  result.successful = false;
  result.reason = std::move(reason);
  return result;
}

bool nearly_equal(double a, double b) {
  return std::fabs(a - b) <= std::numeric_limits<double>::epsilon() * std::fabs(a + b) * 100.0;
}

// Both ends of a range belong to it, even if they are not a whole number of steps apart.
bool in_range(const rcl_interfaces::msg::IntegerRange& range, int64_t value) {
  if (value == range.from_value || value == range.to_value) {
    return true;
  }
  if (value < range.from_value || value > range.to_value) {
    return false;
  }
  const uint64_t distance = static_cast<uint64_t>(value) - static_cast<uint64_t>(range.from_value);
  return range.step == 0 || distance % range.step == 0;
}

bool in_range(const rcl_interfaces::msg::FloatingPointRange& range, double value) {
  if (nearly_equal(value, range.from_value) || nearly_equal(value, range.to_value)) {
    return true;
  }
  if (!(value >= range.from_value && value <= range.to_value)) {
    return false;
  }
  return range.step == 0.0 ||
         nearly_equal(value, range.from_value + range.step * std::round((value - range.from_value) / range.step));
}

// Whether the value, or each value of the array, complies with the range if there is one.
template <typename RangesT, typename ValueT, typename ValuesT>
bool are_in_range(const RangesT& ranges, std::uint8_t type, std::uint8_t single, const ValueT& value,
                  std::uint8_t array, const ValuesT& values) {
  if (ranges.empty()) {
    return true;
  }
  const auto complies = [&](const auto& one) { return in_range(ranges.front(), one); };
  return (type != single || complies(value)) && (type != array || std::all_of(values.begin(), values.end(), complies));
}

}  // namespace

std::string wrong_type_reason(const std::string& name, ParameterType expected, ParameterType actual) {
  return "Wrong parameter type, parameter {" + name + "} is of type {" + to_string(expected) + "}, setting it to {" +
         to_string(actual) + "} is not allowed.";
}

SetParametersResult check_constraints(const ParameterDescriptor& descriptor, const ParameterValue& value) {
  if (!descriptor.dynamic_typing && descriptor.type != PARAMETER_NOT_SET && descriptor.type != value.get_type()) {
    return failure(wrong_type_reason(descriptor.name, static_cast<ParameterType>(descriptor.type), value.get_type()));
  }
  if (descriptor.integer_range.empty() && descriptor.floating_point_range.empty()) {
    return success();
  }
  const auto& message = value.to_value_msg();
  const bool out_of_integer_range =
      !are_in_range(descriptor.integer_range, message.type, PARAMETER_INTEGER, message.integer_value,
                    PARAMETER_INTEGER_ARRAY, message.integer_array_value);
  const bool out_of_floating_point_range =
      !are_in_range(descriptor.floating_point_range, message.type, PARAMETER_DOUBLE, message.double_value,
                    PARAMETER_DOUBLE_ARRAY, message.double_array_value);
  if (out_of_integer_range || out_of_floating_point_range) {
    return failure("Parameter {" + descriptor.name + "} doesn't comply with " +
                   (out_of_integer_range ? "integer" : "floating point") + " range.");
  }
  return success();
}

}  // namespace rclcpp
