// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_cursor.hpp"

#include <utility>

namespace launch {

namespace {

// Without a limit, a file that is not XML at all could give an error for each of its characters.
constexpr std::size_t kMaximumErrors = 20;

}  // namespace

SourceRange XmlCursor::range(std::size_t begin, std::size_t end) const {
  return {markup.file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

bool XmlCursor::skip_blanks() {
  const std::size_t begin = position;
  while (position < text.size() && is_xml_blank(text[position])) {
    ++position;
  }
  return position > begin;
}

std::string_view XmlCursor::take_name() {
  const std::size_t begin = position;
  if (position < text.size() && is_xml_name_start(text[position])) {
    while (position < text.size() && is_xml_name_character(text[position])) {
      ++position;
    }
  }
  return text.substr(begin, position - begin);
}

void XmlCursor::error(std::string message, std::size_t begin, std::size_t end, std::string help) {
  if (!stopped) {
    markup.errors.push_back({Severity::kError, std::move(message), range(begin, end), std::move(help)});
    stopped = markup.errors.size() >= kMaximumErrors;
  }
}

void XmlCursor::fatal(std::string message, std::size_t begin, std::size_t end, std::string help) {
  error(std::move(message), begin, end, std::move(help));
  stopped = true;
}

}  // namespace launch
