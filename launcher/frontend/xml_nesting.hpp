// SPDX-License-Identifier: Apache-2.0
// Finds the errors of an XML file as a whole: tags that don't match, text outside the root element, namespace prefixes
// that are not declared.
//
// tinyxml2 knows how elements nest. This class is used when tinyxml2 refuses a file, or when it accepts a file that
// expat may refuse.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

// tinyxml2 refuses a depth of 100.
inline constexpr std::size_t kMaximumXmlDepth = 90;

// Call the functions for the pieces of the file in document order. They add their errors to the cursor.
class XmlNesting {
 public:
  bool is_outside() const { return open_.empty(); }
  bool has_root() const { return has_root_; }

  void text_outside(XmlCursor& cursor, std::size_t begin, std::size_t end);
  void begin_start_tag(XmlCursor& cursor, XmlSpan name);
  // The attributes of the tag begin at `first_attribute` in the markup of the cursor. `closed`: the tag ends with "/>".
  void end_start_tag(XmlCursor& cursor, std::size_t first_attribute, bool closed);
  void end_tag(XmlCursor& cursor, XmlSpan name);
  void finish(XmlCursor& cursor);

 private:
  struct Open {
    std::string_view name;
    std::size_t begin;                       // the place of its "<"
    std::vector<std::string_view> prefixes;  // declared by xmlns:prefix
  };

  static void never_closed(XmlCursor& cursor, const Open& element, std::string help);
  void check_prefix(XmlCursor& cursor, const Open& element, XmlSpan name) const;

  std::vector<Open> open_;
  std::optional<Open> last_self_closed_;
  bool has_root_ = false;
};

}  // namespace launch
