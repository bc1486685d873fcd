// SPDX-License-Identifier: Apache-2.0
// Parameters as text: in parameter files, and on the command line of a node.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>

#include "launcher/language/parameter_value.hpp"

namespace launch {

namespace {

// Whether a node reads the unquoted text as this string.
bool reads_as_string(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:@+-";
  constexpr std::string_view kOtherTypes[] = {"y",    "n",     "yes",  "no",  "on",       "off",
                                              "true", "false", "null", "inf", "infinity", "nan"};
  if (text.empty() || text.find_first_not_of(kPlain) != std::string::npos || text.ends_with(':')) {
    return false;
  }
  std::string lower;
  for (const char character : text) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  const bool begins_as_text =
      std::isalpha(static_cast<unsigned char>(text.front())) || text.front() == '/' || text.front() == '_';
  return begins_as_text && std::find(std::begin(kOtherTypes), std::end(kOtherTypes), lower) == std::end(kOtherTypes);
}

// A single byte in base64.
std::string base64_of(std::byte byte) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto value = std::to_integer<std::size_t>(byte);
  return {kDigits[value >> 2], kDigits[(value & 3) << 4], '=', '='};
}

std::string scalar_to_yaml(const ParameterScalar& scalar) {
  if (const bool* const boolean = std::get_if<bool>(&scalar)) {
    return *boolean ? "true" : "false";
  }
  if (const std::int64_t* const number = std::get_if<std::int64_t>(&scalar)) {
    return fmt::format("{}", *number);
  }
  if (const double* const number = std::get_if<double>(&scalar)) {
    if (std::isnan(*number)) {
      return ".nan";
    }
    if (std::isinf(*number)) {
      return *number > 0 ? ".inf" : "-.inf";
    }
    std::string digits = fmt::format("{}", *number);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
  }
  if (const std::byte* const byte = std::get_if<std::byte>(&scalar)) {
    return fmt::format("!!binary {}", base64_of(*byte));
  }
  std::string quoted = "\"";
  for (const char character : std::get<std::string>(scalar)) {
    switch (character) {
      case '"':
      case '\\':
        quoted += '\\';
        quoted += character;
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(character) < 0x20 || character == 0x7f) {
          quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(character));
        } else {
          quoted += character;
        }
    }
  }
  return quoted + '"';
}

}  // namespace

std::string to_yaml(const ParameterValue& value) {
  if (const auto* const scalar = std::get_if<ParameterScalar>(&value)) {
    return scalar_to_yaml(*scalar);
  }
  std::string text;
  for (const ParameterScalar& item : std::get<std::vector<ParameterScalar>>(value)) {
    text += (text.empty() ? "" : ", ") + scalar_to_yaml(item);
  }
  return "[" + text + "]";
}

std::string to_argument(const ParameterValue& value) {
  const auto* const scalar = std::get_if<ParameterScalar>(&value);
  if (scalar == nullptr) {
    return to_yaml(value);
  }
  if (const auto* const text = std::get_if<std::string>(scalar)) {
    return reads_as_string(*text) ? *text : to_yaml(value);
  }
  // "True" is a boolean for nodes, too; not-a-number and infinity have other names in Python and in YAML.
  return std::holds_alternative<bool>(*scalar) ? to_python_text(value) : to_yaml(value);
}

std::string quote_yaml_if_needed(const std::string& key) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
  const bool plain = !key.empty() && key.find_first_not_of(kPlain) == std::string::npos && key.front() != '-';
  return plain ? key : scalar_to_yaml(key);
}

}  // namespace launch
