// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/input_text.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "base/text/utf8.hpp"

namespace launch {

namespace {

// A number of bytes at the beginning that are ASCII without control characters. More of them may follow, because only
// whole groups of eight bytes are counted.
std::size_t ordinary_prefix(std::string_view text) {
  constexpr std::uint64_t kHighBits = 0x8080808080808080;
  constexpr std::uint64_t kFirstPrintable = 0x2020202020202020;
  std::size_t size = 0;
  for (std::uint64_t eight = 0; size + sizeof eight <= text.size(); size += sizeof eight) {
    std::memcpy(&eight, text.data() + size, sizeof eight);
    // The high bit of a byte is set here if the byte is below 0x20 or above 0x7F.
    if (((eight | (eight - kFirstPrintable)) & kHighBits) != 0) {
      break;
    }
  }
  return size;
}

}  // namespace

std::optional<Diagnostic> find_bad_character(const LocatedText& source) {
  const std::string_view text = source.text();
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return Diagnostic{Severity::kError, "the file is encoded in UTF-16", source.range(0, 0), "save it as UTF-8"};
  }
  for (std::size_t i = 0; i < text.size();) {
    i += ordinary_prefix(text.substr(i));
    if (i == text.size()) {
      break;
    }
    const auto byte = static_cast<unsigned char>(text[i]);  // char is signed on some processors only
    if ((byte >= 0x20 && byte < 0x80) || byte == '\n') {
      ++i;
      continue;
    }
    const CodePoint character = decode_utf8(text.substr(i));
    if (!character.valid) {
      return Diagnostic{Severity::kError, fmt::format("the byte 0x{:02X} is not UTF-8", byte), source.range(i, 1),
                        "save the file as UTF-8"};
    }
    if (character.value < 0x20 && text[i] != '\t' && text[i] != '\n' && text[i] != '\r') {
      return Diagnostic{Severity::kError,
                        fmt::format("the control character U+{:04X} is not allowed in a launch file",
                                    static_cast<std::uint32_t>(character.value)),
                        source.range(i, 1),
                        {}};
    }
    i += character.size;
  }
  return std::nullopt;
}

}  // namespace launch
