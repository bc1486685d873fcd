// SPDX-License-Identifier: Apache-2.0
// The types of YAML 1.1 as PyYAML resolves them (yaml/resolver.py, yaml/constructor.py). yaml-cpp's own conversions
// follow YAML 1.2 and differ in octal, sexagesimal and exponent forms.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
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

// Takes characters off the front of a text.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool at_end() const { return text_.empty(); }
  bool take(char c) {
    if (!text_.starts_with(c)) {
      return false;
    }
    text_.remove_prefix(1);
    return true;
  }
  bool take(std::string_view word) {
    if (!text_.starts_with(word)) {
      return false;
    }
    text_.remove_prefix(word.size());
    return true;
  }
  void take_sign() {
    if (text_.starts_with('+') || text_.starts_with('-')) {
      text_.remove_prefix(1);
    }
  }
  // Takes the longest run of characters of the set.
  std::string_view take_any(std::string_view set) {
    const std::string_view run = text_.substr(0, text_.find_first_not_of(set));
    text_.remove_prefix(run.size());
    return run;
  }

 private:
  std::string_view text_;
};

constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kDigitsAndUnderscore = "0123456789_";

// [0-9][0-9_]*
bool take_decimal(Reader& reader) {
  const std::string_view run = reader.take_any(kDigitsAndUnderscore);
  return !run.empty() && is_digit(run.front());
}

// (:[0-5]?[0-9])+
bool take_sexagesimal_tail(Reader& reader) {
  bool any = false;
  while (reader.take(':')) {
    const std::string_view run = reader.take_any(kDigits);
    if (run.empty() || run.size() > 2 || (run.size() == 2 && run.front() > '5')) {
      return false;
    }
    any = true;
  }
  return any;
}

// ([eE][-+][0-9]+)?, then the end
bool take_exponent_and_end(Reader& reader) {
  if (reader.take('e') || reader.take('E')) {
    if (!reader.take('+') && !reader.take('-')) {
      return false;
    }
    if (reader.take_any(kDigits).empty()) {
      return false;
    }
  }
  return reader.at_end();
}

bool is_float(std::string_view text) {
  Reader fraction(text);
  if (fraction.take('.')) {  // no sign here: -.5 is a text
    if (take_decimal(fraction)) {
      return take_exponent_and_end(fraction);
    }
    return is_one_of(text, std::array<std::string_view, 6>{".inf", ".Inf", ".INF", ".nan", ".NaN", ".NAN"});
  }
  Reader reader(text);
  reader.take_sign();
  if (reader.take('.')) {
    return reader.take("inf") || reader.take("Inf") || reader.take("INF") ? reader.at_end() : false;
  }
  if (!take_decimal(reader)) {
    return false;
  }
  if (reader.take('.')) {
    reader.take_any(kDigitsAndUnderscore);
    return take_exponent_and_end(reader);
  }
  if (!take_sexagesimal_tail(reader) || !reader.take('.')) {
    return false;
  }
  reader.take_any(kDigitsAndUnderscore);
  return reader.at_end();
}

bool is_int(std::string_view text) {
  Reader signless(text);
  signless.take_sign();
  if (Reader reader = signless; reader.take("0b")) {
    return !reader.take_any("01_").empty() && reader.at_end();
  }
  if (Reader reader = signless; reader.take("0x")) {
    return !reader.take_any("0123456789abcdefABCDEF_").empty() && reader.at_end();
  }
  if (Reader reader = signless; reader.take('0')) {
    reader.take_any("01234567_");
    return reader.at_end();
  }
  Reader reader = signless;
  return take_decimal(reader) && (reader.at_end() || (take_sexagesimal_tail(reader) && reader.at_end()));
}

// YYYY-MM-DD. A time of day may follow.
bool is_timestamp(std::string_view text) {
  const auto number = [](Reader& reader, std::size_t least, std::size_t most) {
    const std::size_t size = reader.take_any(kDigits).size();
    return size >= least && size <= most;
  };
  Reader reader(text);
  if (!number(reader, 4, 4) || !reader.take('-')) {
    return false;
  }
  if (Reader date = reader; number(date, 2, 2) && date.take('-') && number(date, 2, 2) && date.at_end()) {
    return true;
  }
  if (!number(reader, 1, 2) || !reader.take('-') || !number(reader, 1, 2)) {
    return false;
  }
  if (!reader.take('T') && !reader.take('t') && reader.take_any(" \t").empty()) {
    return false;
  }
  if (!number(reader, 1, 2) || !reader.take(':') || !number(reader, 2, 2) || !reader.take(':') ||
      !number(reader, 2, 2)) {
    return false;
  }
  if (reader.take('.')) {
    reader.take_any(kDigits);
  }
  reader.take_any(" \t");
  if (reader.take('Z') || reader.at_end()) {
    return reader.at_end();
  }
  if (!reader.take('+') && !reader.take('-')) {
    return false;
  }
  return number(reader, 1, 2) && (!reader.take(':') || number(reader, 2, 2)) && reader.at_end();
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
  } else if (!may_be_number(text)) {
    // a string
  } else if (is_float(text)) {
    scalar.type = Scalar::Type::kFloat;
    scalar.float_value = float_value(text);
  } else if (is_int(text)) {
    if (const std::optional<std::int64_t> value = int_value(text)) {
      scalar.type = Scalar::Type::kInt;
      scalar.int_value = *value;
    } else {
      scalar.type = Scalar::Type::kOther;
    }
  } else if (is_timestamp(text)) {
    scalar.type = Scalar::Type::kOther;
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
