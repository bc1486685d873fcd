// SPDX-License-Identifier: Apache-2.0
// What each word of a launch file is, for the colours of an editor.
#include <algorithm>
#include <vector>

#include "programs/launch/lsp/features.hpp"

namespace launch::lsp {

namespace {

enum Type { kTag, kAttribute, kSubstitution, kConfiguration };

struct Token {
  Span span;
  Type type;
};

// The names of the substitutions of a value, and the configurations that it reads.
void add_substitutions(const std::string& text, Span value, std::vector<Token>& tokens) {
  for (std::size_t at = text.find("$(", value.begin); at < value.end; at = text.find("$(", at + 2)) {
    const std::size_t begin = at + 2;
    const std::size_t end = std::min(text.find_first_of(" ()\n", begin), value.end);
    tokens.push_back({{begin, end}, kSubstitution});
    if (text.compare(begin, end - begin, "var") == 0 && end < value.end && text[end] == ' ') {
      const std::size_t name_end = std::min(text.find_first_of(" ()'\"\n", end + 1), value.end);
      tokens.push_back({{end + 1, name_end}, kConfiguration});
    }
  }
}

}  // namespace

Json semantic_token_legend() {
  return {{"tokenTypes", {"class", "property", "function", "variable"}}, {"tokenModifiers", Json::array()}};
}

Json semantic_tokens(const Reading& reading) {
  std::vector<Token> tokens;
  for (const OutlineElement& element : reading.outline.elements) {
    tokens.push_back({element.tag_span, kTag});
    for (const OutlineAttribute& attribute : element.attributes) {
      tokens.push_back({attribute.name_span, kAttribute});
      if (attribute.value) {
        add_substitutions(reading.document.text(), *attribute.value, tokens);
      }
    }
  }
  std::sort(tokens.begin(), tokens.end(),
            [](const Token& left, const Token& right) { return left.span.begin < right.span.begin; });
  // Five numbers each: lines and characters since the token before, length, type, modifiers.
  Json data = Json::array();
  std::size_t behind = 0;
  std::size_t last_line = 0;
  std::size_t last_character = 0;
  for (const Token& token : tokens) {
    if (token.span.begin < behind || token.span.end <= token.span.begin) {
      continue;  // a file that is being written may say one thing twice
    }
    const Json begin = reading.document.position(token.span.begin);
    const Json end = reading.document.position(token.span.end);
    const auto line = begin.at("line").get<std::size_t>();
    const auto character = begin.at("character").get<std::size_t>();
    if (end.at("line") != line) {
      continue;
    }
    data.insert(data.end(), {line - last_line, line == last_line ? character - last_character : character,
                             end.at("character").get<std::size_t>() - character, token.type, 0});
    last_line = line;
    last_character = character;
    behind = token.span.end;
  }
  return {{"data", std::move(data)}};
}

}  // namespace launch::lsp
