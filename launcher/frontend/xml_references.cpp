// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

bool is_xml_character(char32_t c) {
  return c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c <= 0xD7FF) || (c >= 0xE000 && c <= 0xFFFD) ||
         (c >= 0x10000 && c <= 0x10FFFF);
}

constexpr std::array<std::string_view, 5> kEntities = {"lt", "gt", "amp", "quot", "apos"};

bool is_character_number(std::string_view text, int base) {
  std::uint32_t value = 0;
  const auto [last, failure] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return failure == std::errc() && last == text.data() + text.size() && is_xml_character(value);
}

void check_reference(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string_view text = cursor.text.substr(begin, end - begin);
  std::size_t size = 1;
  while (size < text.size() && (is_xml_name_character(text[size]) || text[size] == '#')) {
    ++size;
  }
  if (size == 1 || size == text.size() || text[size] != ';') {
    cursor.error("'&' starts no entity here", begin, begin + 1, "write &amp; for the character itself");
    return;
  }
  const std::string_view name = text.substr(1, size - 1);
  ++size;
  if (name.starts_with('#')) {
    const bool is_character =
        name.starts_with("#x") ? is_character_number(name.substr(2), 16) : is_character_number(name.substr(1), 10);
    if (!is_character) {
      cursor.error(fmt::format("'&{};' is not a character", name), begin, begin + size);
    }
  } else if (std::find(kEntities.begin(), kEntities.end(), name) == kEntities.end()) {
    cursor.error(fmt::format("unknown entity '&{};'", name), begin, begin + size,
                 cursor.markup.has_doctype ? "entities declared in a DOCTYPE are not supported"
                                           : "XML knows &lt; &gt; &amp; &quot; &apos; and &#number; only");
  }
}

}  // namespace

void check_xml_references(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string_view text = cursor.text.substr(0, end);
  for (std::size_t at = text.find('&', begin); at != std::string_view::npos; at = text.find('&', at + 1)) {
    check_reference(cursor, at, end);
  }
}

}  // namespace launch
