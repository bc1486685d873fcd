#include <string_view>

#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

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
  constexpr std::string_view kInside = "_-./+$()=;~'\"\\,<>";
  if (text.empty() || !can_begin(text) || text.back() == ' ') {
    return false;
  }
  for (std::size_t i = 1; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_inner_colon = c == ':' && i + 1 < text.size() && text[i + 1] != ' ';
    if (!is_alphanumeric(c) && c != ' ' && kInside.find(c) == std::string_view::npos && !is_inner_colon) {
      return false;
    }
  }
  return true;
}

}  // namespace launch
