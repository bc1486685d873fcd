// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_entities.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "base/text/utf8.hpp"

namespace launch {

namespace {

// Entities of entities can make a short text stand for a huge one.
constexpr std::size_t kLongest = 64UL << 10U;
constexpr int kDeepest = 16;

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(kBlanks), text.size()));
}

// "name" and "text" of what stands behind "<!ENTITY"; nullopt for an entity of another kind.
std::optional<std::pair<std::string_view, std::string_view>> declaration(std::string_view text) {
  text = without_blanks(text);
  const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n\"'%>"));
  text = without_blanks(text.substr(name.size()));
  if (name.empty() || text.empty() || (text.front() != '"' && text.front() != '\'')) {
    return std::nullopt;
  }
  const std::size_t end = text.find(text.front(), 1);
  return end == std::string_view::npos ? std::nullopt : std::optional(std::pair(name, text.substr(1, end - 1)));
}

class Resolver {
 public:
  explicit Resolver(const std::map<std::string_view, std::string_view>& declared) : declared_(declared) {}

  // Nullopt where the text can't stand in the value of an attribute.
  std::optional<std::string> resolved(std::string_view text, int depth = 0) const {
    std::string result;
    while (!text.empty()) {
      if (text.front() != '&') {
        const char c = text.front();
        if (c == '<' || result.size() > kLongest) {
          return std::nullopt;
        }
        result += kBlanks.find(c) == std::string_view::npos ? c : ' ';
        text.remove_prefix(1);
        continue;
      }
      const std::size_t end = text.find(';');
      const std::optional<std::string> piece =
          end == std::string_view::npos || depth == kDeepest ? std::nullopt : reference(text.substr(1, end - 1), depth);
      if (!piece || result.size() + piece->size() > kLongest) {
        return std::nullopt;
      }
      result += *piece;
      text.remove_prefix(end + 1);
    }
    return result;
  }

 private:
  std::optional<std::string> reference(std::string_view name, int depth) const {
    if (name.starts_with('#')) {
      const bool is_hexadecimal = name.starts_with("#x");
      name.remove_prefix(is_hexadecimal ? 2 : 1);
      std::uint32_t number = 0;
      const auto [end, error] =
          std::from_chars(name.data(), name.data() + name.size(), number, is_hexadecimal ? 16 : 10);
      // A character that is written as a number counts as markup when the entity is used.
      if (error != std::errc() || end != name.data() + name.size() || number == '<' || number == '&') {
        return std::nullopt;
      }
      std::string character;
      append_utf8(character, static_cast<char32_t>(number));
      return character == "\n" || character == "\t" || character == "\r" ? " " : character;
    }
    static const std::map<std::string_view, std::string_view> kKnown = {
        {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}};
    if (const auto known = kKnown.find(name); known != kKnown.end()) {
      return std::string(known->second);
    }
    const auto found = declared_.find(name);
    return found == declared_.end() ? std::nullopt : resolved(found->second, depth + 1);
  }

  const std::map<std::string_view, std::string_view>& declared_;
};

}  // namespace

XmlEntities declared_entities(std::string_view doctype) {
  constexpr std::string_view kMark = "<!ENTITY";
  std::map<std::string_view, std::string_view> declared;
  for (std::size_t at = doctype.find('<', 1); at != std::string_view::npos; at = doctype.find('<', at + 1)) {
    if (doctype.substr(at).starts_with("<!--")) {
      at = doctype.find("-->", at);
      if (at == std::string_view::npos) {
        break;
      }
    } else if (doctype.substr(at).starts_with(kMark)) {
      if (const auto found = declaration(doctype.substr(at + kMark.size()))) {
        declared.insert(*found);  // the first one counts
        at = static_cast<std::size_t>(found->second.data() - doctype.data()) + found->second.size();
      }
    }
  }
  XmlEntities entities;
  for (const auto& [name, text] : declared) {
    if (std::optional<std::string> resolved = Resolver(declared).resolved(text)) {
      entities.emplace(name, std::move(*resolved));
    }
  }
  return entities;
}

}  // namespace launch
