// SPDX-License-Identifier: Apache-2.0
// Explains what is wrong with an XML file as a whole: tags that don't match, text outside the root element, namespace
// prefixes that are not declared.
//
// tinyxml2 knows how elements nest. This class is asked where it refuses a file, or accepts one that expat could
// refuse.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

// tinyxml2 stops at 100.
inline constexpr std::size_t kMaximumXmlDepth = 90;

// Gets the pieces of the file in their order; errors go to the cursor.
class XmlNesting {
 public:
  bool is_outside() const { return open_.empty(); }
  bool has_root() const { return has_root_; }

  void text_outside(XmlCursor& cursor, std::size_t begin, std::size_t end);
  void begin_start_tag(XmlCursor& cursor, XmlSpan name);
  // Its attributes are those of the cursor's markup from `first_attribute` on; `closed` tells that it ends with "/>".
  void end_start_tag(XmlCursor& cursor, std::size_t first_attribute, bool closed);
  void end_tag(XmlCursor& cursor, XmlSpan name);
  void finish(XmlCursor& cursor);

 private:
  struct Open {
    std::string_view name;
    std::size_t begin;                       // of the tag, its "<"
    std::vector<std::string_view> prefixes;  // that it declares by xmlns:prefix
  };

  static void never_closed(XmlCursor& cursor, const Open& element, std::string help);
  void check_prefix(XmlCursor& cursor, const Open& element, XmlSpan name) const;

  std::vector<Open> open_;
  std::optional<Open> last_self_closed_;
  bool has_root_ = false;
};

}  // namespace launch
