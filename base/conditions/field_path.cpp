// SPDX-License-Identifier: Apache-2.0
#include "base/conditions/field_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

constexpr std::string_view kNameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

std::size_t behind(std::string_view text, std::string_view characters, std::size_t at) {
  return std::min(text.find_first_not_of(characters, at), text.size());
}

std::size_t behind_blanks(std::string_view text, std::size_t at) {
  return behind(text, " \t\r\n", at);
}

}  // namespace

FieldPath FieldPath::parse(const LocatedText& text) {
  std::size_t at = 0;
  FieldPath path = take(text, at);
  at = behind_blanks(text.text(), at);
  if (at < text.text().size()) {
    throw LaunchError(fmt::format("unexpected '{}'", text.text().substr(at)), text.range(at, text.text().size() - at));
  }
  return path;
}

FieldPath FieldPath::take(const LocatedText& located, std::size_t& at) {
  const std::string_view text = located.text();
  FieldPath path;
  // Made in its place: GCC 12 takes the text of a moved number for read.
  const auto add = [&path](auto step, std::size_t begin, std::size_t end) {
    Part& part = path.parts.emplace_back();
    part.step = std::move(step);
    part.begin = begin;
    part.end = end;
  };
  bool may_be_name = true;
  for (;;) {
    const std::size_t begin = behind_blanks(text, at);
    const char next = begin < text.size() ? text[begin] : '\0';
    if (next == '.') {
      at = begin + 1;
      may_be_name = true;
    } else if (next == '[') {
      std::size_t index = 0;
      const auto [stop, error] = std::from_chars(text.data() + begin + 1, text.data() + text.size(), index);
      if (error != std::errc()) {
        throw LaunchError("expected the number of an element", located.range(begin + 1, 1), "write it as in [0]");
      }
      const std::size_t close = behind_blanks(text, static_cast<std::size_t>(stop - text.data()));
      if (close == text.size() || text[close] != ']') {
        throw LaunchError("expected ']'", located.range(close, 1));
      }
      at = close + 1;
      add(index, begin, at);
      may_be_name = at < text.size() && kNameCharacters.find(text[at]) != kNameCharacters.npos;
    } else {
      const std::size_t end = behind(text, kNameCharacters, begin);
      if (!may_be_name || end == begin) {
        return path;
      }
      at = end;
      add(std::string(text.substr(begin, end - begin)), begin, end);
      may_be_name = false;
    }
  }
}

}  // namespace launch
