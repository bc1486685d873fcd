// SPDX-License-Identifier: Apache-2.0
// Reads launch files into Entity trees.
#pragma once

#include <memory>
#include <string_view>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/entity.hpp"

namespace launch {

// Parses XML or YAML. The content decides: XML begins with "<", and no YAML launch file does. So a file with the suffix
// of the other format loads, too, as in ROS 2, which tries the formats in turn. Returns the root entity, whose
// type_name is "launch". Throws LaunchError with all syntax errors that it finds.
Entity load_entity_tree(const std::shared_ptr<const SourceFile>& file);

Entity parse_xml(const std::shared_ptr<const SourceFile>& file);   // xml_frontend.cpp
Entity parse_yaml(const std::shared_ptr<const SourceFile>& file);  // yaml_frontend.cpp

// Finds the type and value of a text by the scalar rules of YAML 1.1, as PyYAML's safe loader does: 010 is 8, yes is
// true, 1e3 is a string. It serves plain scalars of YAML files and parameter values of XML files.
Scalar yaml11_scalar(LocatedText text);  // yaml11.cpp
void set_yaml11_type(Scalar& scalar);    // by `scalar.text`

// The text is not YAML at all. A LaunchError of another type may tell of YAML that can't be used.
class YamlSyntaxError : public LaunchError {
 public:
  using LaunchError::LaunchError;
};

// Reads a whole text as YAML 1.1: a scalar or a list. Parameter values such as "[1, 2]" or "- 1" are read so. Throws
// YamlSyntaxError if the text is not valid YAML, LaunchError if it is a mapping.
Value yaml11_value(const LocatedText& text);  // yaml11.cpp

}  // namespace launch
