// SPDX-License-Identifier: Apache-2.0
// Where the tags and attributes of an XML file stand, and what is wrong with it.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/base/source.hpp"

namespace launch {

// Bytes [begin, end) of the text.
struct XmlSpan {
  std::uint32_t begin;
  std::uint32_t end;
};

struct XmlMarkup {
  std::string_view view(XmlSpan where) const {
    return std::string_view(file->text()).substr(where.begin, where.end - where.begin);
  }

  // In UTF-8: the file that was given, or one made of it when its declaration names another encoding.
  std::shared_ptr<const SourceFile> file;
  // In document order: the names of all start tags, and the attributes of all of them.
  std::vector<XmlSpan> tags;
  std::vector<XmlSpan> attribute_names;
  std::vector<XmlSpan> attribute_values;  // without their quotes
  // What tinyxml2 can't read: processing instructions, which it refuses inside the root, and a DOCTYPE, which it ends
  // at its first '>'.
  std::vector<XmlSpan> hidden;
  bool has_doctype = false;
  // The file could be one that tinyxml2 accepts although its nesting is wrong: it has text or tags outside the root,
  // deep nesting, a DOCTYPE or names of the form "a:b".
  bool is_doubtful = false;
  std::vector<Diagnostic> errors;
};

}  // namespace launch
