// SPDX-License-Identifier: Apache-2.0
// Finds the errors of an XML file, before tinyxml2 reads it.
//
// tinyxml2 decides what the tree is and where its names and values stand. But it stops at the first error without
// telling the column, and it accepts files that conforming parsers refuse, such as expat, which ROS 2 uses. This pass
// goes from tag to tag. It keeps nothing of the content.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"
#include "launcher/frontend/xml_entities.hpp"

namespace launch {

struct XmlScan {
  // The given file, or a copy of it in UTF-8 if its declaration names another encoding.
  std::shared_ptr<const SourceFile> file;
  // The text of `file`, with blanks in place of what tinyxml2 can't read.
  std::string readable;
  // The name of the root element, a part of the text of `file`.
  std::string_view root;
  XmlEntities entities;
  std::vector<Diagnostic> errors;
};

XmlScan scan_xml(const std::shared_ptr<const SourceFile>& file);

}  // namespace launch
