// SPDX-License-Identifier: Apache-2.0
// A place in the text of an XML file, and what the parts of the scanner share: blanks, names, errors.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/base/source.hpp"

namespace launch {

struct XmlTag;

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
  explicit XmlCursor(const std::shared_ptr<const SourceFile>& source) : file(source), text(source->text()) {}

  SourceRange range(std::size_t begin, std::size_t end) const;
  std::uint32_t line(std::size_t offset) const { return file->position(offset).line; }
  std::string_view rest() const { return text.substr(position); }
  bool at(std::string_view what) const { return rest().starts_with(what); }

  // True when there was a blank.
  bool skip_blanks();
  // Empty when no name stands here.
  std::string_view take_name();

  // Adds an error. After too many the scan stops.
  void error(std::string message, std::size_t begin, std::size_t end, std::string help = {});
  // Adds an error that leaves no sense in what follows, and stops the scan.
  void fatal(std::string message, std::size_t begin, std::size_t end, std::string help = {});

  std::shared_ptr<const SourceFile> file;
  std::string_view text;
  std::size_t position = 0;
  std::vector<Diagnostic> errors;
  bool stopped = false;
  bool latin1 = false;       // the declaration says so
  bool has_doctype = false;  // which might have declared entities
};

// Reads <?xml ... ?>, which stands at the cursor.
void read_xml_declaration(XmlCursor& cursor);

// Reads the attributes of a start tag, up to its end; true when it ends with "/>". `tag_begin` is its "<".
bool read_xml_attributes(XmlCursor& cursor, XmlTag& tag, std::size_t tag_begin);  // xml_attributes.cpp

// Decodes the attribute value in [begin, end): entities, white space.
LocatedText decode_xml_attribute(XmlCursor& cursor, std::size_t begin, std::size_t end);

// What the reference at `begin` ("&" ...) stands for, and its size in the file.
std::pair<std::string, std::size_t> decode_xml_reference(XmlCursor& cursor, std::size_t begin, std::size_t end);

}  // namespace launch
