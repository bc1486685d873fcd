// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/event_pattern.hpp"

namespace tracing {

bool matches_pattern(std::string_view pattern, std::string_view text) {
  // The place to continue when the text after the last star does not match: one character later.
  std::size_t star = std::string_view::npos;
  std::size_t behind_star = 0;
  std::size_t at = 0;
  std::size_t next = 0;
  while (next < text.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      behind_star = next;
    } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == text[next])) {
      ++at;
      ++next;
    } else if (star != std::string_view::npos) {
      at = star + 1;
      next = ++behind_star;
    } else {
      return false;
    }
  }
  while (at < pattern.size() && pattern[at] == '*') {
    ++at;
  }
  return at == pattern.size();
}

}  // namespace tracing
