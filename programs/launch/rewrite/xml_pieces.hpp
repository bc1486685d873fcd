// SPDX-License-Identifier: Apache-2.0
// A well-formed XML text as a list of its pieces, comments included, so that it can be written anew.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace launch {

struct XmlPiece {
  enum class Kind {
    kOther,  // the declaration, a DOCTYPE, a processing instruction, CDATA
    kComment,
    kText,  // without the blanks around it
    kStart,
    kEmpty,  // a tag that ends with "/>"
    kEnd
  };

  struct Attribute {
    std::string_view name;
    std::string_view value;  // as written, without its quotes
    char quote = '"';
  };

  Kind kind = Kind::kOther;
  std::string_view text;              // the whole piece
  std::string_view name;              // of a tag
  std::vector<Attribute> attributes;  // of kStart and kEmpty
  std::size_t line_ends_before = 0;   // between this piece and the one before
};

// The text must be one that parse_xml() takes.
std::vector<XmlPiece> xml_pieces(std::string_view text);

}  // namespace launch
