// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "launcher/base/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

bool is_xml_character(char32_t c) {
  return c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c <= 0xD7FF) || (c >= 0xE000 && c <= 0xFFFD) ||
         (c >= 0x10000 && c <= 0x10FFFF);
}

}  // namespace

LocatedText decode_xml_attribute(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string_view raw = cursor.text.substr(begin, end - begin);
  const auto stands_for_itself = [](char c) { return c != '&' && (c == ' ' || !is_xml_blank(c)); };
  if (!cursor.latin1 && std::all_of(raw.begin(), raw.end(), stands_for_itself)) {
    return LocatedText(std::string(raw), cursor.range(begin, end));
  }
  LocatedText value({}, cursor.range(begin, begin));
  const auto add = [&](std::string_view decoded, std::size_t from, std::size_t to) {
    value.append(decoded, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
  };
  for (std::size_t i = begin; i < end;) {
    const char c = cursor.text[i];
    if (c == '&') {
      const auto [decoded, size] = decode_xml_reference(cursor, i, end);
      add(decoded, i, i + size);
      i += size;
    } else if (c == '\r' && i + 1 < end && cursor.text[i + 1] == '\n') {
      add(" ", i, i + 2);
      i += 2;
    } else if (is_xml_blank(c)) {
      add(" ", i, i + 1);
      ++i;
    } else if (cursor.latin1 && static_cast<unsigned char>(c) >= 0x80) {
      std::string decoded;
      append_utf8(decoded, static_cast<unsigned char>(c));
      add(decoded, i, i + 1);
      ++i;
    } else {
      std::size_t stop = i + 1;
      while (stop < end && cursor.text[stop] != '&' && !is_xml_blank(cursor.text[stop]) &&
             !(cursor.latin1 && static_cast<unsigned char>(cursor.text[stop]) >= 0x80)) {
        ++stop;
      }
      add(cursor.text.substr(i, stop - i), i, stop);
      i = stop;
    }
  }
  return value;
}

std::pair<std::string, std::size_t> decode_xml_reference(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string_view text = cursor.text.substr(begin, end - begin);
  std::size_t size = 1;
  while (size < text.size() && (is_xml_name_character(text[size]) || text[size] == '#')) {
    ++size;
  }
  if (size == 1 || size == text.size() || text[size] != ';') {
    cursor.error("'&' starts no entity here", begin, begin + 1, "write &amp; for the character itself");
    return {"&", 1};
  }
  const std::string_view name = text.substr(1, size - 1);
  ++size;
  if (name.starts_with('#')) {
    const bool hexadecimal = name.starts_with("#x");
    const std::string_view digits = name.substr(hexadecimal ? 2 : 1);
    std::uint32_t value = 0;
    const auto [last, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
    if (failure != std::errc() || last != digits.data() + digits.size() || !is_xml_character(value)) {
      cursor.error(fmt::format("'&{};' is not a character", name), begin, begin + size);
      return {"?", size};
    }
    std::string decoded;
    append_utf8(decoded, value);
    return {decoded, size};
  }
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kEntities = {
      {{"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}}};
  const auto* known = std::find_if(kEntities.begin(), kEntities.end(), [&](const auto& e) { return e.first == name; });
  if (known == kEntities.end()) {
    cursor.error(fmt::format("unknown entity '&{};'", name), begin, begin + size,
                 cursor.has_doctype ? "entities declared in a DOCTYPE are not supported"
                                    : "XML knows &lt; &gt; &amp; &quot; &apos; and &#number; only");
    return {"?", size};
  }
  return {std::string(known->second), size};
}

}  // namespace launch
