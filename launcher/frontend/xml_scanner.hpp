// SPDX-License-Identifier: Apache-2.0
// Finds where the tags and attributes of an XML file stand, and checks that the file is well-formed.
//
// tinyxml2 gives the tree, but no columns, and it accepts files that conforming parsers (expat, and with it ROS 2)
// refuse. The scanner fills both gaps from the same text; of attributes tinyxml2 sees nothing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/base/source.hpp"
#include "launcher/frontend/entity.hpp"

namespace launch {

struct XmlTag {
  std::string name;
  SourceRange where;
  // Values with entities decoded and white space normalised; their places without the quotes, unless they are empty.
  std::vector<Attribute> attributes;
};

struct XmlScan {
  std::vector<XmlTag> tags;  // one per element, in the order of the start tags
  // The start and end tags without their attributes, which is all that tinyxml2 is given: it refuses processing
  // instructions inside the root and ends a DOCTYPE at its first '>'.
  std::string markup;
  std::vector<Diagnostic> errors;
};

XmlScan scan_xml(const std::shared_ptr<const SourceFile>& file);

}  // namespace launch
