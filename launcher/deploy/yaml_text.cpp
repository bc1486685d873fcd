// SPDX-License-Identifier: Apache-2.0
// Texts are written so that readers of YAML 1.1 and 1.2 read the same: each in quotes, and in them nothing but
// printable characters that end no line in either.
#include "launcher/deploy/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/text/utf8.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kIndent = 2;

// Whole files stay readable: lines of printable ASCII, of which the first begins with no blank, and one line end behind
// the last. A literal block does not hold other texts as they are.
bool is_plain_file(const std::string& text) {
  const auto is_plain = [](unsigned char c) { return c == '\n' || (c >= ' ' && c < 0x7f); };
  return text.size() > 1 && text.ends_with('\n') && text[text.size() - 2] != '\n' && text.front() != ' ' &&
         text.front() != '\n' && std::all_of(text.begin(), text.end(), is_plain);
}

bool is_printable(char32_t c) {
  const bool ends_line = c == 0x85 || c == 0x2028 || c == 0x2029;
  return !ends_line && ((c >= ' ' && c < 0x7f) || (c >= 0xa0 && c < 0xd800) || (c >= 0xe000 && c < 0xfeff) ||
                        (c > 0xfeff && c < 0xfffe) || c >= 0x10000);
}

std::string quoted(const std::string& text) {
  std::string all;
  append_as_utf8(all, text);
  std::string result = "\"";
  for (std::string_view rest = all; !rest.empty();) {
    const CodePoint point = decode_utf8(rest);
    const char32_t c = point.value;
    if (c == '"' || c == '\\') {
      result += {'\\', static_cast<char>(c)};
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (is_printable(c)) {
      result += rest.substr(0, point.size);
    } else {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    }
    rest.remove_prefix(point.size);
  }
  return result + '"';
}

// Names of keys that YAML 1.1 reads as truth values or nothing are in quotes, too.
std::string key_text(const std::string& key) {
  constexpr std::array<std::string_view, 9> kNoTexts = {"y", "n", "yes", "no", "true", "false", "on", "off", "null"};
  std::string lower;
  std::transform(key.begin(), key.end(), std::back_inserter(lower),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto is_plain = [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/');
  };
  const bool plain = !key.empty() && std::isalpha(static_cast<unsigned char>(key.front())) != 0 &&
                     std::all_of(key.begin(), key.end(), is_plain) &&
                     std::find(kNoTexts.begin(), kNoTexts.end(), lower) == kNoTexts.end();
  return plain ? key : quoted(key);
}

std::string literal(const std::string& text, const std::string& margin) {
  std::string result = "|";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    result += "\n" + (end == begin ? "" : margin + text.substr(begin, end - begin));
    begin = end + 1;
  }
  return result + "\n";
}

// What stands behind "key:" or "-", with the end of the line; `margin` is before what stands below.
void write(std::string& out, const Json& value, std::size_t depth, bool in_list) {
  const std::string margin(depth * kIndent, ' ');
  if (value.is_object() && !value.empty()) {
    out += in_list ? " " : "\n";
    bool is_first = in_list;
    for (const auto& [key, item] : value.items()) {
      out += (is_first ? "" : margin) + key_text(key) + ":";
      is_first = false;
      write(out, item, depth + 1, false);
    }
  } else if (value.is_array() && !value.empty()) {
    out += "\n";
    for (const Json& item : value) {
      out += margin + "-";
      write(out, item, depth + 1, true);
    }
  } else if (value.is_object() || value.is_array()) {
    out += value.is_object() ? " {}\n" : " []\n";
  } else if (value.is_string()) {
    const std::string text = value.get<std::string>();
    out += " " + (is_plain_file(text) ? literal(text, margin) : quoted(text) + "\n");
  } else {
    out += " " + value.dump() + "\n";  // numbers and truth values
  }
}

}  // namespace

std::string as_yaml(const Json& value) {
  std::string text;
  write(text, value, 0, false);
  return text.substr(1);
}

}  // namespace launch
