// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string_view>

#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// What may stand anywhere inside; a colon may, too, where no blank follows.
constexpr std::array<bool, 256> kInside = [] {
  std::array<bool, 256> inside{};
  for (const char c : std::string_view("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                       " _-./+$()=;~'\"\\,<>")) {
    inside[static_cast<unsigned char>(c)] = true;
  }
  return inside;
}();

// What a plain scalar may begin with; the other indicators of YAML begin something else.
bool can_begin(std::string_view text) {
  const char first = text.front();
  if (first == '-' || first == '+' || first == '.') {  // numbers; neither "- item" nor "---" nor "..."
    return text.size() > 1 && (is_alphanumeric(text[1]) || (text[1] == '.' && first != '.'));
  }
  return is_alphanumeric(first) || first == '_' || first == '/' || first == '$';
}

}  // namespace

bool is_plain_scalar(std::string_view text) {
  if (text.empty() || !can_begin(text) || text.back() == ' ') {
    return false;
  }
  for (std::size_t i = 1; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_inner_colon = c == ':' && i + 1 < text.size() && text[i + 1] != ' ';
    if (!kInside[static_cast<unsigned char>(c)] && !is_inner_colon) {
      return false;
    }
  }
  return true;
}

}  // namespace launch
