// SPDX-License-Identifier: Apache-2.0
// The places of the tags and attributes of an XML file, and its errors.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

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

  // The given file, or a copy of it in UTF-8 if its declaration names another encoding.
  std::shared_ptr<const SourceFile> file;
  // The names of all start tags, and their attributes. All are in document order.
  std::vector<XmlSpan> tags;
  std::vector<XmlSpan> attribute_names;
  std::vector<XmlSpan> attribute_values;  // without their quotes
  // The parts that tinyxml2 can't read: processing instructions, which it refuses inside the root, and a DOCTYPE, which
  // it ends at the first '>'.
  std::vector<XmlSpan> hidden;
  bool has_doctype = false;
  // tinyxml2 may accept the file although its nesting is wrong. This can happen if the file has text or tags outside
  // the root, deep nesting, a DOCTYPE or names of the form "a:b".
  bool is_doubtful = false;
  std::vector<Diagnostic> errors;
};

}  // namespace launch
