// SPDX-License-Identifier: Apache-2.0
// Parameters as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

// "[a, 'b: c']"
std::string yaml_list(const std::vector<std::string>& texts);

// The rcl_interfaces/msg/ParameterValue for a value as a person writes it, as YAML: "{type: 2, integer_value: 3}" for
// "3". What is no bool, number, or list of such or of texts, is a text.
std::string parameter_value_yaml(const std::string& text);

}  // namespace launch
