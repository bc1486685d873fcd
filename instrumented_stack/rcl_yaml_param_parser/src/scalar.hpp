// SPDX-License-Identifier: Apache-2.0
// The types that ROS 2 gives to plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace rcl_yaml {

using Scalar = std::variant<bool, std::int64_t, double, std::string>;

// The value of a text without quotes. The rules differ from YAML 1.1 and 1.2: `y` and `on` are booleans, integers may
// be hexadecimal or octal, `1e3` and `inf` are floating point numbers, `null` and `~` are strings.
Scalar typed_scalar(std::string text);

// `bool`, `integer`, `double` or `string`.
const char* type_name(const Scalar& value);

}  // namespace rcl_yaml
