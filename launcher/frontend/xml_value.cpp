// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_value.hpp"

#include <algorithm>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "base/text/utf8.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

constexpr std::string_view kDecoded = "&\t\r\n";

// `raw` begins with one of kDecoded. Returns how many of its bytes stand for one character.
std::size_t size_of_decoded(std::string_view raw) {
  if (raw.front() == '&') {
    return raw.find(';') + 1;
  }
  return raw.starts_with("\r\n") ? 2 : 1;
}

}  // namespace

LocatedText locate_xml_value(const SourceRange& where, std::string_view decoded) {
  const std::string_view raw = std::string_view(where.file->text()).substr(where.begin, where.end - where.begin);
  if (raw == decoded && raw.find_first_of(kDecoded) == std::string_view::npos) {
    return LocatedText(std::string(decoded), where);
  }
  LocatedText value({}, {where.file, where.begin, where.begin});
  for (std::size_t at = 0; at < raw.size();) {
    const bool is_verbatim = kDecoded.find(raw[at]) == std::string_view::npos;
    const std::size_t raw_size =
        is_verbatim ? std::min(raw.find_first_of(kDecoded, at), raw.size()) - at : size_of_decoded(raw.substr(at));
    const std::size_t size = is_verbatim ? raw_size : decoded.empty() ? 1 : decode_utf8(decoded).size;
    const std::string_view text = decoded.substr(0, size);
    if (text.size() < size || (is_verbatim && text != raw.substr(at, raw_size))) {
      throw LaunchError("the XML parser reads this value otherwise than it is written", where);
    }
    const auto begin = where.begin + static_cast<std::uint32_t>(at);
    value.append(!is_verbatim && raw[at] != '&' ? " " : text, begin, begin + static_cast<std::uint32_t>(raw_size));
    decoded.remove_prefix(size);
    at += raw_size;
  }
  return value;
}

}  // namespace launch
