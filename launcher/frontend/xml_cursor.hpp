// SPDX-License-Identifier: Apache-2.0
// A place in the text of an XML file, which moves on over names and blanks, and the errors found so far.
//
// Parts of the file are views of its text, so each of them knows its place.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"
#include "launcher/frontend/xml_entities.hpp"

namespace launch {

inline bool is_xml_blank(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
inline bool begins_xml_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}
inline bool continues_xml_name(char c) {
  return begins_xml_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

// The name at the beginning of the text; empty if there is none.
std::string_view leading_xml_name(std::string_view text);

// What stands behind the name of an attribute.
struct XmlAttributeValue {
  bool has_equals_sign = false;
  char quote = '\0';
  bool is_closed = false;
  std::string_view text;  // without its quotes
};

struct XmlCursor {
  explicit XmlCursor(std::shared_ptr<const SourceFile> source) : file(std::move(source)), text(file->text()) {}

  std::string_view rest() const { return text.substr(position); }
  std::string_view from(std::size_t begin) const { return text.substr(begin, position - begin); }
  bool at(std::string_view what) const { return rest().starts_with(what); }
  SourceFile::Position place_of(std::string_view part) const { return file->position(part.data() - text.data()); }

  // True if there was a blank.
  bool skip_blanks();
  std::string_view take_name();
  // If it is not complete, the cursor is where something is missing.
  XmlAttributeValue take_value();

  // Adds an error for each '&' in a part that begins no reference known to XML.
  void check_references(std::string_view part);

  // Adds an error. Stops the reading after too many errors.
  void error(std::string message, std::string_view where, std::string help = {});
  // Adds an error and stops the reading, because the following text can't be understood any more.
  void fatal(std::string message, std::string_view where, std::string help = {});

  std::shared_ptr<const SourceFile> file;
  std::string_view text;  // the whole file
  std::size_t position = 0;
  bool stopped = false;
  bool has_doctype = false;
  XmlEntities entities;  // that the DOCTYPE declares
  std::vector<Diagnostic> errors;
};

// Reads <?xml ... ?>, which stands at the cursor. If the file is in ISO-8859-1, the cursor moves on in a copy of the
// file in UTF-8.
void read_xml_declaration(XmlCursor& cursor);

}  // namespace launch
