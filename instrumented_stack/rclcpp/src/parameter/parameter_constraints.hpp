// SPDX-License-Identifier: Apache-2.0
// Whether a parameter's descriptor allows a value.
#pragma once

#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>

#include "rclcpp/parameter_value.hpp"

namespace rclcpp {

// Unsuccessful, with a reason, if the value violates the type (unless dynamically typed) or the range.
rcl_interfaces::msg::SetParametersResult check_constraints(const rcl_interfaces::msg::ParameterDescriptor& descriptor,
                                                           const ParameterValue& value);

// The reason for a value of the wrong type.
std::string wrong_type_reason(const std::string& name, ParameterType expected, ParameterType actual);

}  // namespace rclcpp
