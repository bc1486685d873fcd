// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/text/ascii.hpp"
#include "base/text/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

// Each may stand once, in this order. Only the version is required.
constexpr std::array<std::string_view, 3> kNames = {"version", "encoding", "standalone"};

constexpr std::array<std::string_view, 3> kLatin1 = {"iso-8859-1", "latin-1", "latin1"};
constexpr std::array<std::string_view, 4> kUtf8 = {"utf-8", "utf8", "us-ascii", "ascii"};

// Makes the cursor go on in a copy of the file in UTF-8. The file is in ISO-8859-1, and the text before the cursor is
// ASCII.
void go_on_in_utf8(XmlCursor& cursor) {
  std::string text(cursor.from(0));
  for (const char byte : cursor.rest()) {
    append_utf8(text, static_cast<unsigned char>(byte));
  }
  cursor.file = std::make_shared<const SourceFile>(cursor.file->path(), std::move(text), cursor.file->included_from());
  cursor.text = cursor.file->text();
}

}  // namespace

void read_xml_declaration(XmlCursor& cursor) {
  const std::string_view mark = cursor.rest().substr(0, 5);
  const std::size_t end = cursor.text.find("?>", cursor.position);
  if (end == std::string_view::npos) {
    cursor.fatal("the XML declaration is not closed", mark, "add '?>' at its end");
    return;
  }
  const std::string_view declaration = cursor.rest().substr(0, end + 2 - cursor.position);
  cursor.position += mark.size();
  const auto* next = kNames.begin();
  std::string encoding;
  while (cursor.skip_blanks(), cursor.position < end) {
    const std::size_t begin = cursor.position;
    const std::string_view name = cursor.take_name();
    const auto* const known = std::find(next, kNames.end(), name);
    const XmlAttributeValue value = cursor.take_value();
    if (known == kNames.end() || (next == kNames.begin() && known != next) || !value.is_closed ||
        cursor.position > end) {
      cursor.fatal("malformed XML declaration", cursor.text.substr(begin, end - begin),
                   "write <?xml version=\"1.0\"?>");
      return;
    }
    const auto is_allowed = [](char c) { return c > 0 && continues_xml_name(c); };
    if (value.text.empty() || !std::all_of(value.text.begin(), value.text.end(), is_allowed)) {
      cursor.fatal(fmt::format("malformed {} in the XML declaration", name),
                   {value.text.data() - 1, value.text.size() + 2});
      return;
    }
    if (name == "encoding") {
      encoding = lower(value.text);
      if (std::find(kLatin1.begin(), kLatin1.end(), encoding) == kLatin1.end() &&
          std::find(kUtf8.begin(), kUtf8.end(), encoding) == kUtf8.end()) {
        cursor.error(fmt::format("the encoding '{}' is not supported", value.text), value.text,
                     "save the file as UTF-8");
      }
    }
    next = known + 1;
  }
  if (next == kNames.begin()) {
    cursor.fatal("the XML declaration lacks its version", declaration, "write <?xml version=\"1.0\"?>");
    return;
  }
  cursor.position = end + 2;
  if (std::find(kLatin1.begin(), kLatin1.end(), encoding) != kLatin1.end()) {
    go_on_in_utf8(cursor);
  }
}
}  // namespace launch
