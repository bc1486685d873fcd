// SPDX-License-Identifier: Apache-2.0
// Finds the places of the tags and attributes of an XML file, and the errors in each piece of its markup.
//
// tinyxml2 reads the content of the file. But it gives no columns, stops at the first error, and accepts files that
// conforming parsers refuse, such as expat, which ROS 2 uses. This pass goes through the text once more, from tag to
// tag. It does not check how elements nest. XmlNesting (xml_nesting.hpp) does so when tinyxml2 refuses a file.
#pragma once

#include <memory>

#include "launcher/frontend/xml_markup.hpp"
#include "launcher/frontend/xml_nesting.hpp"

namespace launch {

// If `nesting` is given, it adds the errors of the file as a whole.
XmlMarkup read_xml_markup(const std::shared_ptr<const SourceFile>& file, XmlNesting* nesting = nullptr);

}  // namespace launch
