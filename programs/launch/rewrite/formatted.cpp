// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/formatted.hpp"

#include <algorithm>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/same_tree.hpp"

namespace launch {

namespace {

bool is_xml(std::string_view text) {
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

std::string with_plain_line_ends(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i).starts_with("\r\n")) {
      continue;
    }
    result += text[i];
  }
  return result;
}

std::string with_crlf(std::string_view text) {
  std::string result;
  for (const char c : text) {
    result += c == '\n' ? "\r\n" : std::string(1, c);
  }
  return result;
}

}  // namespace

std::string formatted(const std::shared_ptr<const SourceFile>& file, const Registry& registry) {
  const Entity before = load_entity_tree(file);
  const std::string& given = file->text();
  const bool crlf = given.find("\r\n") != std::string::npos && given.find("\r\n") + 1 == given.find('\n');
  const auto plain = std::make_shared<SourceFile>(file->path(), with_plain_line_ends(given));
  const std::string text = is_xml(given) ? formatted_xml(plain->text(), registry) : formatted_yaml(plain);
  const std::string result = crlf ? with_crlf(text) : text;
  const SourceRange whole{file, 0, 0};
  try {
    if (is_same_tree(before, load_entity_tree(std::make_shared<SourceFile>(file->path(), result)))) {
      return result;
    }
  } catch (const LaunchError&) {
    // told below
  }
  throw LaunchError("this file can't be formatted: its meaning would change", whole,
                    "it stays as it is; please report it");
}

}  // namespace launch
