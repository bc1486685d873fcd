// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of a start tag.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/text/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

void unexpected_in_tag(XmlCursor& cursor, std::string_view tag, std::size_t tag_begin) {
  if (cursor.at("<")) {
    cursor.error(fmt::format("the tag <{}> is not closed", tag), tag_begin, tag_begin + 1 + tag.size(),
                 fmt::format("add '>' or '/>' before the '<' on line {}", cursor.line(cursor.position)));
    return;
  }
  const CodePoint character = decode_utf8(cursor.rest());
  cursor.error(fmt::format("unexpected '{}' in the tag <{}>", cursor.rest().substr(0, character.size), tag),
               cursor.position, cursor.position + character.size, "expected an attribute, '>' or '/>'");
}

// Moves behind the tag after an error in it, so that the rest of the file is checked, too.
bool skip_tag(XmlCursor& cursor) {
  const std::size_t end = cursor.text.find_first_of("<>", cursor.position);
  cursor.position = std::min(end, cursor.text.size());
  if (!cursor.at(">")) {
    return true;
  }
  ++cursor.position;
  return cursor.text[cursor.position - 2] == '/';
}

// Reads "= value" and adds the attribute. False if the rest of the tag can't be read.
bool read_attribute(XmlCursor& cursor, std::string_view tag, std::size_t first_attribute, std::string_view name,
                    std::size_t begin) {
  const std::size_t name_end = cursor.position;
  cursor.skip_blanks();
  if (!cursor.at("=")) {
    cursor.error(fmt::format("the attribute '{}' of <{}> has no value", name, tag), begin, name_end,
                 fmt::format("write {}=\"...\"", name));
    return false;
  }
  ++cursor.position;
  cursor.skip_blanks();
  const char quote = cursor.position < cursor.text.size() ? cursor.text[cursor.position] : '\0';
  if (quote != '"' && quote != '\'') {
    cursor.error(fmt::format("the value of the attribute '{}' must stand in quotes", name), cursor.position,
                 std::min(cursor.position + 1, cursor.text.size()));
    return false;
  }
  const std::size_t value_begin = cursor.position + 1;
  const std::size_t value_end = cursor.text.find(quote, value_begin);
  if (value_end == std::string_view::npos) {
    cursor.fatal(fmt::format("the value of the attribute '{}' is not closed", name), cursor.position,
                 cursor.position + 1, fmt::format("add {} at its end", quote));
    return false;
  }
  cursor.position = value_end + 1;
  const std::size_t less = cursor.text.substr(0, value_end).find('<', value_begin);
  if (less != std::string_view::npos) {
    cursor.error(fmt::format("'<' in the value of the attribute '{}'", name), less, less + 1,
                 fmt::format("write &lt; for the character, or add the quote {} that is missing before it", quote));
    const bool quote_is_missing = cursor.position < cursor.text.size() && !is_xml_blank(cursor.text[cursor.position]) &&
                                  !cursor.at(">") && !cursor.at("/>");
    if (quote_is_missing) {
      cursor.stopped = true;
      return false;
    }
  }
  check_xml_references(cursor, value_begin, value_end);
  std::vector<XmlSpan>& names = cursor.markup.attribute_names;
  const auto same = std::find_if(names.begin() + static_cast<std::ptrdiff_t>(first_attribute), names.end(),
                                 [&](const XmlSpan& other) { return cursor.markup.view(other) == name; });
  if (same != names.end()) {
    const SourceFile::Position first = cursor.markup.file->position(same->begin);
    cursor.error(fmt::format("duplicate attribute '{}' of <{}>", name, tag), begin, name_end,
                 fmt::format("it was given first at line {}, column {}", first.line, first.column));
  }
  cursor.markup.is_doubtful |= name.find(':') != std::string_view::npos;
  names.push_back(cursor.span(begin, name_end));
  cursor.markup.attribute_values.push_back(cursor.span(value_begin, value_end));
  return true;
}

}  // namespace

bool read_xml_attributes(XmlCursor& cursor, std::string_view tag, std::size_t tag_begin) {
  const std::size_t first_attribute = cursor.markup.attribute_names.size();
  while (true) {
    const bool blank = cursor.skip_blanks();
    if (cursor.position >= cursor.text.size()) {
      cursor.fatal(fmt::format("the tag <{}> is not closed", tag), tag_begin, tag_begin + 1 + tag.size(),
                   "add '>' or '/>' at its end");
      return false;
    }
    if (cursor.at(">")) {
      ++cursor.position;
      return false;
    }
    if (cursor.at("/>")) {
      cursor.position += 2;
      return true;
    }
    const std::size_t begin = cursor.position;
    if (!is_xml_name_start(cursor.text[begin])) {
      unexpected_in_tag(cursor, tag, tag_begin);
      return skip_tag(cursor);
    }
    const std::string_view name = cursor.take_name();
    if (!blank) {
      cursor.error(fmt::format("no white space before the attribute '{}'", name), begin, cursor.position,
                   cursor.markup.attribute_names.size() == first_attribute ? "" : "is a quote missing before it?");
      return skip_tag(cursor);
    }
    if (!read_attribute(cursor, tag, first_attribute, name, begin)) {
      return cursor.stopped ? false : skip_tag(cursor);
    }
  }
}

}  // namespace launch
