// SPDX-License-Identifier: Apache-2.0
// The types that ROS 2 gives to the single values of parameter files. Nodes and the launcher, which reads files for
// components and checks them, use this one function.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rcl_yaml {

using Bytes = std::vector<std::uint8_t>;
using Scalar = std::variant<bool, std::int64_t, double, std::string, Bytes>;

// What YAML says of a scalar beside its text.
struct ScalarForm {
  bool is_quoted = false;     // in quotes; the text of a block (| or >) is not
  std::string_view tag = {};  // as the parser of YAML resolves it, such as tag:yaml.org,2002:int; empty: none
};

// With its article: "a bool", "an integer", "a double", "a string", "a list of bytes".
inline const char* type_name(const Scalar& value) {
  constexpr std::array<const char*, 5> kNames{"a bool", "an integer", "a double", "a string", "a list of bytes"};
  return kNames[value.index()];
}

namespace scalar_rules {

inline std::optional<bool> as_bool(std::string_view text) {
  constexpr std::array<std::string_view, 11> kTrue{"y",    "Y",    "yes", "Yes", "YES", "true",
                                                   "True", "TRUE", "on",  "On",  "ON"};
  constexpr std::array<std::string_view, 11> kFalse{"n",     "N",     "no",  "No",  "NO", "false",
                                                    "False", "FALSE", "off", "Off", "OFF"};
  if (std::find(kTrue.begin(), kTrue.end(), text) != kTrue.end()) {
    return true;
  }
  if (std::find(kFalse.begin(), kFalse.end(), text) != kFalse.end()) {
    return false;
  }
  return std::nullopt;
}

inline std::optional<std::int64_t> as_int(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(text.c_str(), &end, 0);
  if (text.empty() || errno != 0 || end != text.c_str() + text.size()) {
    return std::nullopt;
  }
  return value;
}

// A program may have set a locale that writes decimals with a comma, as user interfaces do.
inline double to_double(const char* text, char** end) {
  static const locale_t kC = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text, end, kC);
}

inline std::optional<double> as_double(const std::string& text) {
  // YAML writes `.inf` and `.nan`; strtod expects `inf` and `nan`. Only these ways to write them are numbers.
  constexpr std::array<std::string_view, 12> kSpecial{".nan",  ".NaN",  ".NAN",  ".inf",  ".Inf",  ".INF",
                                                      "+.inf", "+.Inf", "+.INF", "-.inf", "-.Inf", "-.INF"};
  std::string number = text;
  if (std::find(kSpecial.begin(), kSpecial.end(), text) != kSpecial.end()) {
    number.erase(number.find('.'), 1);
  }
  char* end = nullptr;
  errno = 0;
  const double value = to_double(number.c_str(), &end);
  if (number.empty() || errno != 0 || end != number.c_str() + number.size()) {
    return std::nullopt;
  }
  return value;
}

// Base64; blanks and line breaks do not count.
inline std::optional<Bytes> as_bytes(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes bytes;
  std::uint32_t bits = 0;
  std::size_t digits = 0;
  std::size_t padding = 0;
  for (const char character : text) {
    if (character == ' ' || character == '\t' || character == '\r' || character == '\n') {
      continue;
    }
    const std::size_t digit = kDigits.find(character);
    if (character == '=') {
      ++padding;
    } else if (digit == std::string_view::npos || padding != 0) {
      return std::nullopt;
    } else {
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
      if (++digits % 4 != 1) {
        bytes.push_back(static_cast<std::uint8_t>(bits >> (4 - digits % 4) % 4 * 2));
      }
    }
  }
  const bool is_whole = (digits + padding) % 4 == 0 && padding <= 2 && digits % 4 != 1;
  return is_whole ? std::optional(bytes) : std::nullopt;
}

[[noreturn]] inline void fail(const std::string& what) {
  throw std::invalid_argument(what);
}

template <typename T>
Scalar required(const std::optional<T>& value, const std::string& text, const char* is_no) {
  if (!value) {
    fail("'" + text + "' is no " + is_no);
  }
  return *value;
}

inline Scalar tagged(const std::string& text, std::string_view tag) {
  constexpr std::string_view kStandard = "tag:yaml.org,2002:";
  const std::string_view name = tag.substr(0, kStandard.size()) == kStandard ? tag.substr(kStandard.size()) : "";
  if (name == "str") {
    return text;
  }
  if (name == "bool") {
    return required(as_bool(text), text, "bool, as the tag !!bool says");
  }
  if (name == "int") {
    return required(as_int(text), text, "integer, as the tag !!int says");
  }
  if (name == "float") {
    return required(as_double(text), text, "double, as the tag !!float says");
  }
  if (name == "binary") {
    return required(as_bytes(text), text, "base64, as the tag !!binary says");
  }
  fail("the tag '" + (name.empty() ? std::string(tag) : "!!" + std::string(name)) +
       "' is not one of !!bool, !!int, !!float, !!str, !!binary");
}

}  // namespace scalar_rules

// The value of a scalar. The rules differ from YAML 1.1 and 1.2: `y` and `on` are bools, integers may be hexadecimal or
// octal, `1e3` and `inf` are doubles, `null` and `~` are strings. A tag says the type, also of a text in quotes:
// `!!float 10` is 10.0, `!!binary AQID` are the bytes 1, 2 and 3. Throws std::invalid_argument with what is wrong when
// the text does not fit the tag, or when no parameter can have the tag.
inline Scalar typed_scalar(const std::string& text, const ScalarForm& form) {
  using namespace scalar_rules;
  if (!form.tag.empty() && form.tag != "!") {
    return tagged(text, form.tag);
  }
  if (form.is_quoted) {
    return text;
  }
  if (const auto value = as_bool(text)) {
    return *value;
  }
  if (const auto value = as_int(text)) {
    return *value;
  }
  if (const auto value = as_double(text)) {
    return *value;
  }
  return text;
}

}  // namespace rcl_yaml
