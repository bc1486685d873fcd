// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "base/text/ascii.hpp"
#include "base/text/utf8.hpp"

namespace launch {

namespace {

// Without a limit, a file that is not XML at all could give an error for each of its characters.
constexpr std::size_t kMaximumErrors = 20;

constexpr std::array<std::string_view, 5> kEntities = {"lt", "gt", "amp", "quot", "apos"};

// The text is "#65" or "#x41".
bool is_character_number(std::string_view text) {
  const bool is_hexadecimal = text.starts_with("#x");
  const char* const end = text.data() + text.size();
  std::uint32_t c = 0;
  const auto [last, failure] =
      std::from_chars(text.data() + (is_hexadecimal ? 2 : 1), end, c, is_hexadecimal ? 16 : 10);
  return failure == std::errc() && last == end &&
         (c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c <= 0xD7FF) || (c >= 0xE000 && c <= 0xFFFD) ||
          (c >= 0x10000 && c <= 0x10FFFF));
}

// What the XML declaration may hold: each once, in this order. Only the version is required.
constexpr std::array<std::string_view, 3> kDeclarationNames = {"version", "encoding", "standalone"};

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

std::string_view leading_xml_name(std::string_view text) {
  if (text.empty() || !begins_xml_name(text.front())) {
    return text.substr(0, 0);
  }
  return text.substr(0, std::find_if_not(text.begin(), text.end(), continues_xml_name) - text.begin());
}

bool XmlCursor::skip_blanks() {
  const std::size_t begin = position;
  while (position < text.size() && is_xml_blank(text[position])) {
    ++position;
  }
  return position > begin;
}

std::string_view XmlCursor::take_name() {
  const std::string_view name = leading_xml_name(rest());
  position += name.size();
  return name;
}

XmlAttributeValue XmlCursor::take_value() {
  XmlAttributeValue value;
  skip_blanks();
  value.has_equals_sign = at("=");
  if (!value.has_equals_sign) {
    return value;
  }
  ++position;
  skip_blanks();
  if (!at("\"") && !at("'")) {
    return value;
  }
  value.quote = text[position];
  const std::size_t end = text.find(value.quote, position + 1);
  if (end != std::string_view::npos) {
    value.is_closed = true;
    value.text = text.substr(position + 1, end - position - 1);
    position = end + 1;
  }
  return value;
}

void XmlCursor::check_references(std::string_view part) {
  for (std::size_t i = part.find('&'); i != std::string_view::npos && !stopped; i = part.find('&', i + 1)) {
    const std::size_t end = part.find(';', i);
    const std::string_view reference = part.substr(i, end == std::string_view::npos ? 1 : end + 1 - i);
    const std::string_view name = reference.substr(1, reference.size() < 2 ? 0 : reference.size() - 2);
    const auto can_be_in_name = [](char c) { return c == '#' || continues_xml_name(c); };
    if (name.empty() || !std::all_of(name.begin(), name.end(), can_be_in_name)) {
      error("'&' starts no entity here", part.substr(i, 1), "write &amp; for the character itself");
    } else if (name.starts_with('#') && !is_character_number(name)) {
      error(fmt::format("'{}' is not a character", reference), reference);
    } else if (!name.starts_with('#') && std::find(kEntities.begin(), kEntities.end(), name) == kEntities.end() &&
               !entities.contains(name)) {
      error(fmt::format("unknown entity '{}'", reference), reference,
            has_doctype
                ? "the DOCTYPE declares no text of this name; entities of other files and of elements are not read"
                : "XML knows &lt; &gt; &amp; &quot; &apos; and &#number; only");
    }
  }
}

void XmlCursor::error(std::string message, std::string_view where, std::string help) {
  if (!stopped) {
    const auto begin = static_cast<std::uint32_t>(where.data() - text.data());
    const auto end = begin + static_cast<std::uint32_t>(where.size());
    errors.push_back({Severity::kError, std::move(message), {file, begin, end}, std::move(help)});
    stopped = errors.size() >= kMaximumErrors;
  }
}

void XmlCursor::fatal(std::string message, std::string_view where, std::string help) {
  error(std::move(message), where, std::move(help));
  stopped = true;
}

void read_xml_declaration(XmlCursor& cursor) {
  const std::string_view mark = cursor.rest().substr(0, 5);
  const std::size_t end = cursor.text.find("?>", cursor.position);
  if (end == std::string_view::npos) {
    cursor.fatal("the XML declaration is not closed", mark, "add '?>' at its end");
    return;
  }
  const std::string_view declaration = cursor.rest().substr(0, end + 2 - cursor.position);
  cursor.position += mark.size();
  const auto* next = kDeclarationNames.begin();
  std::string encoding;
  while (cursor.skip_blanks(), cursor.position < end) {
    const std::size_t begin = cursor.position;
    const std::string_view name = cursor.take_name();
    const auto* const known = std::find(next, kDeclarationNames.end(), name);
    const XmlAttributeValue value = cursor.take_value();
    if (known == kDeclarationNames.end() || (next == kDeclarationNames.begin() && known != next) || !value.is_closed ||
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
  if (next == kDeclarationNames.begin()) {
    cursor.fatal("the XML declaration lacks its version", declaration, "write <?xml version=\"1.0\"?>");
    return;
  }
  cursor.position = end + 2;
  if (std::find(kLatin1.begin(), kLatin1.end(), encoding) != kLatin1.end()) {
    go_on_in_utf8(cursor);
  }
}

}  // namespace launch
