// SPDX-License-Identifier: Apache-2.0
// A place in the text of an XML file. The functions that look for markup move it. They share its functions for blanks,
// names and errors.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/diagnostics/source.hpp"
#include "launcher/frontend/xml_markup.hpp"

namespace launch {

inline constexpr std::string_view kXmlBlanks = " \t\r\n";

inline bool is_xml_blank(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
inline bool is_xml_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}
inline bool is_xml_name_character(char c) {
  return is_xml_name_start(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

struct XmlCursor {
  explicit XmlCursor(const std::shared_ptr<const SourceFile>& file) : text(file->text()) { markup.file = file; }

  XmlSpan span(std::size_t begin, std::size_t end) const {
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }

  SourceRange range(std::size_t begin, std::size_t end) const;
  std::uint32_t line(std::size_t offset) const { return markup.file->position(offset).line; }
  std::string_view rest() const { return text.substr(position); }
  bool at(std::string_view what) const { return rest().starts_with(what); }

  // True if there was a blank.
  bool skip_blanks();
  // Empty if no name stands at the cursor.
  std::string_view take_name();

  // Adds an error. Stops the reading after too many errors.
  void error(std::string message, std::size_t begin, std::size_t end, std::string help = {});
  // Adds an error and stops the reading, because the following text can't be understood any more.
  void fatal(std::string message, std::size_t begin, std::size_t end, std::string help = {});

  XmlMarkup markup;
  std::string_view text;  // the whole file
  std::size_t position = 0;
  bool stopped = false;
};

// Reads <?xml ... ?>, which stands at the cursor. If the file is in ISO-8859-1, the cursor moves on in a copy of the
// file in UTF-8.
void read_xml_declaration(XmlCursor& cursor);  // xml_declaration.cpp

// Reads the attributes of a start tag and its end. True if the tag ends with "/>". `tag_begin` is the place of its "<".
bool read_xml_attributes(XmlCursor& cursor, std::string_view tag, std::size_t tag_begin);  // xml_attributes.cpp

// Adds an error for each '&' in [begin, end) that begins no reference known to XML.
void check_xml_references(XmlCursor& cursor, std::size_t begin, std::size_t end);  // xml_references.cpp

}  // namespace launch
