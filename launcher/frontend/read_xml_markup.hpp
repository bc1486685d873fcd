// SPDX-License-Identifier: Apache-2.0
// Finds where the tags and attributes of an XML file stand, and what is wrong with each piece of its markup.
//
// tinyxml2 reads the file and says what is in it. But it gives no columns, stops at the first error, and accepts files
// that conforming parsers (expat, and with it ROS 2) refuse. This pass goes through the same text from tag to tag. It
// does not know how elements nest; XmlNesting (xml_nesting.hpp) looks at that when tinyxml2 refuses a file.
#pragma once

#include <memory>

#include "launcher/frontend/xml_markup.hpp"
#include "launcher/frontend/xml_nesting.hpp"

namespace launch {

// `nesting`, if given, adds what is wrong with the file as a whole.
XmlMarkup read_xml_markup(const std::shared_ptr<const SourceFile>& file, XmlNesting* nesting = nullptr);

}  // namespace launch
