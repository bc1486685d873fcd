// SPDX-License-Identifier: Apache-2.0
// Single words of parameter files: the types that ROS 2 gives to plain values, and names of nodes.
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

// What is wrong with the name of a node, which may have `*` and `**` in place of whole levels; empty if nothing is.
std::string wrong_in_node_pattern(const std::string& pattern);

}  // namespace rcl_yaml
