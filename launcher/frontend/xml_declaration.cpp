// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/text/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

// The characters of versions and of names of encodings.
constexpr std::string_view kValueCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:-";

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

// Makes the cursor go on in a copy of the file in UTF-8. The file is in ISO-8859-1, and the text before the cursor is
// ASCII.
void go_on_in_utf8(XmlCursor& cursor) {
  std::string text(cursor.text.substr(0, cursor.position));
  for (const char byte : cursor.rest()) {
    append_utf8(text, static_cast<unsigned char>(byte));
  }
  cursor.markup.file = std::make_shared<const SourceFile>(cursor.markup.file->path(), std::move(text),
                                                          cursor.markup.file->included_from());
  cursor.text = cursor.markup.file->text();
}

// True if the encoding is ISO-8859-1. Adds an error if it is neither that nor UTF-8.
bool read_encoding(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string name = lower(cursor.text.substr(begin, end - begin));
  if (name == "iso-8859-1" || name == "latin-1" || name == "latin1") {
    return true;
  }
  if (name != "utf-8" && name != "utf8" && name != "us-ascii" && name != "ascii") {
    cursor.error(fmt::format("the encoding '{}' is not supported", cursor.text.substr(begin, end - begin)), begin, end,
                 "save the file as UTF-8");
  }
  return false;
}

}  // namespace

void read_xml_declaration(XmlCursor& cursor) {
  const std::size_t begin = cursor.position;
  const std::size_t end = cursor.text.find("?>", begin);
  if (end == std::string_view::npos) {
    cursor.fatal("the XML declaration is not closed", begin, begin + 5, "add '?>' at its end");
    return;
  }
  cursor.position = begin + 5;
  // Each may stand once, in this order. Only the version is required.
  constexpr std::array<std::string_view, 3> kNames = {"version", "encoding", "standalone"};
  std::size_t next = 0;
  bool is_latin1 = false;
  while (cursor.skip_blanks(), cursor.position < end) {
    const std::size_t name_begin = cursor.position;
    const std::string_view name = cursor.take_name();
    const auto known = std::find(kNames.begin() + static_cast<std::ptrdiff_t>(next), kNames.end(), name);
    cursor.skip_blanks();
    const bool equals = cursor.position < end && cursor.text[cursor.position] == '=';
    cursor.position += equals ? 1 : 0;
    cursor.skip_blanks();
    const char quote = cursor.position < end ? cursor.text[cursor.position] : '\0';
    const std::size_t close =
        quote == '"' || quote == '\'' ? cursor.text.find(quote, cursor.position + 1) : std::string_view::npos;
    if (known == kNames.end() || !equals || close >= end || (next == 0 && name != "version")) {
      cursor.fatal("malformed XML declaration", name_begin, end, "write <?xml version=\"1.0\"?>");
      return;
    }
    const std::string_view value = cursor.text.substr(cursor.position + 1, close - cursor.position - 1);
    if (value.empty() || value.find_first_not_of(kValueCharacters) != std::string_view::npos) {
      cursor.fatal(fmt::format("malformed {} in the XML declaration", name), cursor.position, close + 1);
      return;
    }
    if (name == "encoding") {
      is_latin1 = read_encoding(cursor, cursor.position + 1, close);
    }
    next = static_cast<std::size_t>(known - kNames.begin()) + 1;
    cursor.position = close + 1;
  }
  if (next == 0) {
    cursor.fatal("the XML declaration lacks its version", begin, end + 2, "write <?xml version=\"1.0\"?>");
    return;
  }
  cursor.position = end + 2;
  if (is_latin1) {
    go_on_in_utf8(cursor);
  }
}

}  // namespace launch
