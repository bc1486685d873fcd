// SPDX-License-Identifier: Apache-2.0
// Values of ROS parameters, and the parameters that a scope gives to every later node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

// A byte is the item of a list only.
using ParameterScalar = std::variant<bool, std::int64_t, double, std::string, std::byte>;
// All items of a list have one type.
using ParameterValue = std::variant<ParameterScalar, std::vector<ParameterScalar>>;

// As Python's str() writes the value: True, 1.0, (1, 2).
std::string to_python_text(const ParameterValue& value);

// The entry that a `set_parameter` or a `set_parameters_from_file` leaves in the scope.
struct NamedParameter {
  std::string name;
  ParameterValue value;
};
struct ParameterFilePath {
  std::string path;
  SourceRange where;  // the place that sets it
};
using GlobalParameter = std::variant<NamedParameter, ParameterFilePath>;

}  // namespace launch
