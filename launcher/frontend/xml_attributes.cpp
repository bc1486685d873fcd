// SPDX-License-Identifier: Apache-2.0
// The attributes of a start tag.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "launcher/base/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"
#include "launcher/frontend/xml_scanner.hpp"

namespace launch {

namespace {

void unexpected_in_tag(XmlCursor& cursor, const XmlTag& tag, std::size_t tag_begin) {
  if (cursor.at("<")) {
    cursor.error(fmt::format("the tag <{}> is not closed", tag.name), tag_begin, tag_begin + 1 + tag.name.size(),
                 fmt::format("add '>' or '/>' before the '<' on line {}", cursor.line(cursor.position)));
    return;
  }
  const CodePoint character = decode_utf8(cursor.rest());
  cursor.error(fmt::format("unexpected '{}' in the tag <{}>", cursor.rest().substr(0, character.size), tag.name),
               cursor.position, cursor.position + character.size, "expected an attribute, '>' or '/>'");
}

// After an error inside a tag: goes on behind it, so that the rest of the file is checked, too.
bool skip_tag(XmlCursor& cursor) {
  const std::size_t end = cursor.text.find_first_of("<>", cursor.position);
  cursor.position = std::min(end, cursor.text.size());
  if (!cursor.at(">")) {
    return true;
  }
  ++cursor.position;
  return cursor.text[cursor.position - 2] == '/';
}

// Reads "= value" and adds the attribute. False when the tag can't be read on.
bool read_attribute(XmlCursor& cursor, XmlTag& tag, std::string_view name, std::size_t begin) {
  const std::size_t name_end = cursor.position;
  cursor.skip_blanks();
  if (!cursor.at("=")) {
    cursor.error(fmt::format("the attribute '{}' of <{}> has no value", name, tag.name), begin, name_end,
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
  LocatedText value = decode_xml_attribute(cursor, value_begin, value_end);
  const bool empty = value_begin == value_end;
  const auto same = std::find_if(tag.attributes.begin(), tag.attributes.end(),
                                 [&](const Attribute& other) { return other.name == name; });
  if (same != tag.attributes.end()) {
    const SourceFile::Position first = cursor.file->position(same->name_where.begin);
    cursor.error(fmt::format("duplicate attribute '{}' of <{}>", name, tag.name), begin, name_end,
                 fmt::format("it was given first at line {}, column {}", first.line, first.column));
  }
  tag.attributes.push_back({std::string(name),
                            cursor.range(begin, name_end),
                            {Scalar{.text = std::move(value)}, empty ? cursor.range(value_begin - 1, value_end + 1)
                                                                     : cursor.range(value_begin, value_end)}});
  return true;
}

}  // namespace

bool read_xml_attributes(XmlCursor& cursor, XmlTag& tag, std::size_t tag_begin) {
  tag.attributes.reserve(2);  // as most tags have
  while (true) {
    const bool blank = cursor.skip_blanks();
    if (cursor.position >= cursor.text.size()) {
      cursor.fatal(fmt::format("the tag <{}> is not closed", tag.name), tag_begin, tag_begin + 1 + tag.name.size(),
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
                   tag.attributes.empty() ? "" : "is a quote missing before it?");
      return skip_tag(cursor);
    }
    if (!read_attribute(cursor, tag, name, begin)) {
      return cursor.stopped ? false : skip_tag(cursor);
    }
  }
}

}  // namespace launch
