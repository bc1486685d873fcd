// SPDX-License-Identifier: Apache-2.0
// The types of YAML 1.1 as PyYAML resolves them (yaml/resolver.py, yaml/constructor.py). yaml-cpp's own conversions
// follow YAML 1.2 and differ in octal, sexagesimal and exponent forms.
#include <fmt/format.h>
#include <regex.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/yaml_document.hpp"

namespace launch {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

template <std::size_t N>
bool is_one_of(std::string_view text, const std::array<std::string_view, N>& words) {
  for (const std::string_view word : words) {
    if (text == word) {
      return true;
    }
  }
  return false;
}

// A pattern of PyYAML's resolver (yaml/resolver.py).
class Pattern {
 public:
  explicit Pattern(const char* text) {
    if (::regcomp(&compiled_, text, REG_EXTENDED | REG_NOSUB) != 0) {
      throw std::logic_error(text);
    }
  }
  bool matches(std::string_view text) const {
    regmatch_t whole{0, static_cast<regoff_t>(text.size())};
    return ::regexec(&compiled_, text.data(), 1, &whole, REG_STARTEND) == 0;
  }

 private:
  regex_t compiled_{};
};

// kInt, kFloat, or kOther for a date; kString if the text is none of them. A pattern is compiled when it is first
// needed, which takes 20 to 60 microseconds. Usual numbers, such as 10 and 0.5, need none.
Scalar::Type type_of_number(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t whole = std::min(text.find_first_not_of(kDigits), text.size());
  if (whole == text.size() && (whole == 1 || text.front() != '0')) {
    return Scalar::Type::kInt;
  }
  if (whole != 0 && text.substr(whole).starts_with('.') &&
      text.find_first_not_of(kDigits, whole + 1) == std::string_view::npos) {
    return Scalar::Type::kFloat;
  }
  static const Pattern int_pattern(
      "^([-+]?0b[01_]+"
      "|[-+]?0[0-7_]*"
      "|[-+]?[1-9][0-9_]*(:[0-5]?[0-9])*"
      "|[-+]?0x[0-9a-fA-F_]+)$");
  if (int_pattern.matches(text)) {
    return Scalar::Type::kInt;
  }
  static const Pattern float_pattern(
      "^([-+]?[0-9][0-9_]*[.][0-9_]*([eE][-+][0-9]+)?"
      "|[.][0-9][0-9_]*([eE][-+][0-9]+)?"  // no sign here: -.5 is a text
      "|[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+[.][0-9_]*"
      "|[-+]?[.](inf|Inf|INF)"
      "|[.](nan|NaN|NAN))$");
  if (float_pattern.matches(text)) {
    return Scalar::Type::kFloat;
  }
  static const Pattern timestamp_pattern(
      "^([0-9]{4}-[0-9]{2}-[0-9]{2}"
      "|[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt]|[ \t]+)[0-9]{1,2}:[0-9]{2}:[0-9]{2}([.][0-9]*)?"
      "[ \t]*(Z|[-+][0-9]{1,2}(:[0-9]{2})?)?)$");
  return timestamp_pattern.matches(text) ? Scalar::Type::kOther : Scalar::Type::kString;
}

std::string without_underscores(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c != '_') {
      result += c;
    }
  }
  return result;
}

// The parts of a base-60 number. Any other number is one part.
std::vector<std::string> colon_parts(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Nullopt if the number does not fit into 64 bits, or has no digit ("0x_").
std::optional<std::int64_t> int_value(std::string_view text) {
  std::string digits = without_underscores(text);
  bool negative = false;
  if (digits.front() == '+' || digits.front() == '-') {
    negative = digits.front() == '-';
    digits.erase(0, 1);
  }
  int base = 10;
  if (digits.starts_with("0b") || digits.starts_with("0x")) {
    base = digits[1] == 'b' ? 2 : 16;
    digits.erase(0, 2);
  } else if (digits.size() > 1 && digits.front() == '0') {
    base = 8;
  }
  std::uint64_t magnitude = 0;
  for (const std::string& part : colon_parts(digits)) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value, base);
    if (error != std::errc() || end != part.data() + part.size() ||
        __builtin_mul_overflow(magnitude, 60U, &magnitude) || __builtin_add_overflow(magnitude, value, &magnitude)) {
      return std::nullopt;
    }
  }
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  if (magnitude > kLargest + (negative ? 1 : 0)) {
    return std::nullopt;
  }
  return negative ? static_cast<std::int64_t>(~magnitude + 1) : static_cast<std::int64_t>(magnitude);
}

double float_value(std::string_view text) {
  std::string digits = without_underscores(text);
  const double sign = digits.front() == '-' ? -1.0 : 1.0;
  if (digits.front() == '+' || digits.front() == '-') {
    digits.erase(0, 1);
  }
  if (digits == ".inf" || digits == ".Inf" || digits == ".INF") {
    return sign * std::numeric_limits<double>::infinity();
  }
  if (digits == ".nan" || digits == ".NaN" || digits == ".NAN") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double value = 0.0;
  for (const std::string& part : colon_parts(digits)) {
    double last = 0.0;
    std::from_chars(part.data(), part.data() + part.size(), last);
    value = value * 60.0 + last;
  }
  return sign * value;
}

bool is_letter_or_digit(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// True for usual words, numbers and templates. They have no indicator of YAML, so each is a plain scalar with this
// text, and no parser is needed. If the result is false, the text may be a plain scalar all the same.
bool is_surely_plain(std::string_view text) {
  constexpr std::string_view kBegins = "_/$";
  // They begin numbers. They also begin "- item", "---" and "...", so a letter or digit must follow.
  constexpr std::string_view kSigns = "+-.";
  constexpr std::string_view kInside = " _-./+$()=;~'\"\\,<>";
  if (text.empty() || text.back() == ' ') {
    return false;
  }
  const bool begins =
      is_letter_or_digit(text.front()) || kBegins.find(text.front()) != std::string_view::npos ||
      (kSigns.find(text.front()) != std::string_view::npos && text.size() > 1 && is_letter_or_digit(text[1]));
  return begins && std::all_of(text.begin() + 1, text.end(), [&](char c) {
           return is_letter_or_digit(c) || kInside.find(c) != std::string_view::npos;
         });
}

Value to_value(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::kMapping) {
    throw LaunchError("expected a scalar or a list, found a mapping", node.where, "quote a text that has ': ' in it");
  }
  if (node.kind == YamlNode::Kind::kScalar) {
    return {node.scalar, node.where};
  }
  std::vector<Value> items;
  for (const YamlNode& item : node.items) {
    items.push_back(to_value(item));
  }
  return {std::move(items), node.where};
}

// Whether the text begins like a number or a date.
bool may_be_number(std::string_view text) {
  return !text.empty() && (is_digit(text.front()) || text.front() == '+' || text.front() == '-' || text.front() == '.');
}
// Whether the text begins like one of the words for booleans and null, and is not longer than these words.
bool may_be_word(std::string_view text) {
  constexpr auto pair = [](int first, int second) { return first * 256 + second; };
  if (text.size() < 2) {
    return text.empty() || text == "~";
  }
  if (text.size() > std::string_view("false").size()) {
    return false;
  }
  switch (pair(text[0] | 0x20, text[1] | 0x20)) {
    case pair('y', 'e'):
    case pair('t', 'r'):
    case pair('o', 'n'):
    case pair('n', 'o'):
    case pair('f', 'a'):
    case pair('o', 'f'):
    case pair('n', 'u'):
      return true;
    default:
      return false;
  }
}

}  // namespace

void set_yaml11_type(Scalar& scalar) {
  const std::string_view text = scalar.text.text();
  scalar.type = Scalar::Type::kString;
  if (!may_be_number(text) && !may_be_word(text)) {
    return;
  }
  if (is_one_of(text, std::array<std::string_view, 9>{"yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"})) {
    scalar.type = Scalar::Type::kBool;
    scalar.bool_value = true;
  } else if (is_one_of(text, std::array<std::string_view, 9>{"no", "No", "NO", "false", "False", "FALSE", "off", "Off",
                                                             "OFF"})) {
    scalar.type = Scalar::Type::kBool;
  } else if (is_one_of(text, std::array<std::string_view, 5>{"", "~", "null", "Null", "NULL"})) {
    scalar.type = Scalar::Type::kNull;
  } else if (may_be_number(text)) {
    scalar.type = type_of_number(text);
  }
  if (scalar.type == Scalar::Type::kFloat) {
    scalar.float_value = float_value(text);
  } else if (scalar.type == Scalar::Type::kInt) {
    const std::optional<std::int64_t> value = int_value(text);
    scalar.type = value ? Scalar::Type::kInt : Scalar::Type::kOther;
    scalar.int_value = value.value_or(0);
  }
}

Scalar yaml11_scalar(LocatedText text) {
  Scalar scalar;
  scalar.text = std::move(text);
  set_yaml11_type(scalar);
  return scalar;
}

Value yaml11_value(const LocatedText& text) {
  if (is_surely_plain(text.text())) {
    return {yaml11_scalar(text), text.range()};
  }
  std::vector<Diagnostic> errors;
  const YamlNode node = read_yaml(text, errors);
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
  return to_value(node);
}

}  // namespace launch
