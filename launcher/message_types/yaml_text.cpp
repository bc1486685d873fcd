// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/yaml_text.hpp"

#include <fmt/format.h>

#include "base/text/utf8.hpp"
#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

bool needs_escape(const CodePoint& character) {
  const char32_t c = character.value;
  return !character.valid || c < 0x20 || c == 0x7F || (c >= 0x80 && c < 0xA0) || c == 0x2028 || c == 0x2029 ||
         c == 0xFEFF;
}

std::string double_quoted(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const CodePoint character = decode_utf8(text);
    const std::string_view bytes = text.substr(0, character.size);
    text.remove_prefix(character.size);
    const char32_t c = character.value;
    if (!character.valid) {
      append_utf8(quoted, 0xFFFD);
    } else if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += bytes;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\t') {
      quoted += "\\t";
    } else if (c == '\r') {
      quoted += "\\r";
    } else if (c == 0) {
      quoted += "\\0";
    } else if (needs_escape(character)) {
      quoted += c < 0x100 ? fmt::format("\\x{:02X}", static_cast<unsigned>(c))
                          : fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      quoted += bytes;
    }
  }
  return quoted + '"';
}

bool has_character_to_escape(std::string_view text) {
  while (!text.empty()) {
    const CodePoint character = decode_utf8(text);
    if (needs_escape(character)) {
      return true;
    }
    text.remove_prefix(character.size);
  }
  return false;
}

bool can_be_plain(std::string_view text, bool in_flow) {
  constexpr std::string_view kIndicators = "#,[]{}&*!|>'\"%@`";
  if (text.empty() || text.front() == ' ' || text.back() == ' ' || text.starts_with("---") || text.starts_with("...") ||
      kIndicators.find(text.front()) != text.npos) {
    return false;
  }
  const bool blank_follows = text.size() == 1 || text[1] == ' ';
  if (((text.front() == '?' || text.front() == ':') && (in_flow || blank_follows)) ||
      (text.front() == '-' && blank_follows)) {
    return false;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_flow && std::string_view(",?[]{}").find(text[i]) != text.npos) {
      return false;
    }
    if (text[i] == ':' && (in_flow || i + 1 == text.size() || text[i + 1] == ' ')) {
      return false;
    }
    if (text[i] == '#' && i > 0 && text[i - 1] == ' ') {
      return false;
    }
  }
  const Scalar scalar = yaml11_scalar(LocatedText(std::string(text)));
  return scalar.type == Scalar::Type::kString && text != "=" && text != "<<";
}

}  // namespace

std::string yaml_text(std::string_view text, bool in_flow) {
  if (has_character_to_escape(text)) {
    return double_quoted(text);
  }
  if (can_be_plain(text, in_flow)) {
    return std::string(text);
  }
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c;
    quoted += c == '\'' ? "'" : "";
  }
  return quoted + "'";
}

}  // namespace launch
