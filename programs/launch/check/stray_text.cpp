// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "programs/launch/check/finders.hpp"

namespace launch {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// The end of the markup that begins at `begin` with '<'. Quoted values of attributes may hold '>'.
std::size_t end_of_markup(std::string_view text, std::size_t begin) {
  const auto behind = [&](std::string_view end) {
    const std::size_t found = text.find(end, begin);
    return found == std::string_view::npos ? text.size() : found + end.size();
  };
  if (text.compare(begin, 4, "<!--") == 0) {
    return behind("-->");
  }
  if (text.compare(begin, 2, "<?") == 0) {
    return behind("?>");
  }
  char quote = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (quote != 0) {
      quote = text[i] == quote ? 0 : quote;
    } else if (text[i] == '"' || text[i] == '\'') {
      quote = text[i];
    } else if (text[i] == '>') {
      return i + 1;
    }
  }
  return text.size();
}

// The end of the text, or of the CDATA section, that begins at `begin`.
std::size_t end_of_text(std::string_view text, std::size_t begin) {
  const std::string_view end = text[begin] == '<' ? "]]>" : "<";
  const std::size_t found = text.find(end, begin);
  return found == std::string_view::npos ? text.size() : found + (text[begin] == '<' ? end.size() : 0);
}

}  // namespace

std::vector<Diagnostic> find_stray_text(const std::shared_ptr<const SourceFile>& file) {
  std::vector<Diagnostic> found;
  const std::string_view text = file->text();
  const std::size_t first = text.find_first_not_of(kBlanks, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  // A DOCTYPE holds declarations, with brackets of their own.
  if (first == std::string_view::npos || text[first] != '<' || text.find("<!DOCTYPE") != std::string_view::npos) {
    return found;
  }
  for (std::size_t at = first; at < text.size();) {
    if (text[at] == '<' && text.compare(at, 9, "<![CDATA[") != 0) {
      at = end_of_markup(text, at);
      continue;
    }
    const std::size_t end = end_of_text(text, at);
    const std::size_t begin = text.find_first_not_of(kBlanks, at);
    if (begin < end) {
      const std::size_t line_end = std::min({text.find('\n', begin), text.size(), end});
      const std::size_t last = text.find_last_not_of(kBlanks, line_end - 1);
      found.push_back({Severity::kWarning, "text between elements has no effect",
                       SourceRange{file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(last + 1)},
                       "put it into an attribute or a comment", Finding::kStrayText});
    }
    at = end;
  }
  return found;
}

}  // namespace launch
