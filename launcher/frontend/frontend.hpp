// SPDX-License-Identifier: Apache-2.0
// Reads launch files into Entity trees.
#pragma once

#include <memory>
#include <string_view>

#include "launcher/base/diagnostic.hpp"
#include "launcher/frontend/entity.hpp"

namespace launch {

// Parses XML or YAML by the content of the file: XML begins with "<", and YAML launch files can't. So a file whose
// suffix names the other format loads as well, as in ROS 2, which tries the formats in turn. Returns the root entity,
// type_name "launch". Throws LaunchError with every syntax error found.
Entity load_entity_tree(const std::shared_ptr<const SourceFile>& file);

Entity parse_xml(const std::shared_ptr<const SourceFile>& file);   // xml_frontend.cpp
Entity parse_yaml(const std::shared_ptr<const SourceFile>& file);  // yaml_frontend.cpp

// Types a piece of text by the scalar rules of YAML 1.1 (as PyYAML's safe loader): 010 is 8, yes is true, 1e3 is a
// string. Used by the YAML front end for plain scalars and by parameter values of XML files.
Scalar yaml11_scalar(LocatedText text);  // yaml11.cpp
void set_yaml11_type(Scalar& scalar);    // what `scalar.text` is

// Text that isn't YAML at all, as opposed to YAML that can't be used.
class YamlSyntaxError : public LaunchError {
 public:
  using LaunchError::LaunchError;
};

// Types a whole text as YAML 1.1 flow or block content: a scalar or a list (parameter values: "[1, 2]", "- 1").
// Throws YamlSyntaxError when it isn't valid YAML, LaunchError for a mapping.
Value yaml11_value(const LocatedText& text);  // yaml11.cpp

}  // namespace launch
