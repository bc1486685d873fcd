// SPDX-License-Identifier: Apache-2.0
// Reads parameter files and values, for rcl and for the structures of C in types.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rcl_yaml_param_parser/types.h"

namespace rcl_yaml {

using ParameterValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<bool>, std::vector<std::int64_t>,
                 std::vector<double>, std::vector<std::string>, std::vector<std::uint8_t>>;

// Told what a file has, in its order. What it throws ends the reading.
class ParameterSink {
 public:
  virtual ~ParameterSink() = default;

  // A node with `ros__parameters`, possibly without any: its name or pattern, as the file writes it.
  virtual void add_node(const std::string& node) = 0;

  // A parameter of the node that came last. Nested names are joined with dots. Without a value, it is an empty list;
  // `place` is FILE:LINE.
  virtual void add_parameter(const std::string& name, std::optional<ParameterValue> value,
                             const std::string& place) = 0;
};

// Reads the text of a file. Throws std::invalid_argument with `FILE:LINE: what is wrong`.
void read_parameters(std::string text, const std::string& file, ParameterSink& sink);

// Throws std::invalid_argument if the file cannot be read.
std::string read_file(const std::string& path);

// Reads a value or a list; an empty list has no value. Throws std::invalid_argument with what is wrong. The name is for
// errors. With `required`, it is wrong if the text has nothing but comments.
std::optional<ParameterValue> read_value(std::string text, const std::string& name, bool required = true);

// Sets a parameter in structures of C; node and parameter are added if they are not there. Throws std::bad_alloc.
void set_parameter(rcl_params_t& params, const std::string& node, const std::string& name,
                   const std::optional<ParameterValue>& value);

}  // namespace rcl_yaml
