// SPDX-License-Identifier: Apache-2.0
// ROS parameters as JSON, for --dry-run=json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "launcher/substitution/parameter.hpp"

namespace launch {

// Numbers that JSON lacks become {"$float": "nan"}, "inf" or "-inf".
nlohmann::ordered_json parameter_as_json(const ParameterValue& value);
// bool, integer, double, string, or one of them with _array.
std::string parameter_type_name(const ParameterValue& value);

// The text of a parameter file, its plain scalars typed as nodes type them: 1e-5 is a number, 12:30 and dates are text.
// Text that is no YAML stays text.
nlohmann::ordered_json parameter_file_as_json(const std::string& text);

}  // namespace launch
