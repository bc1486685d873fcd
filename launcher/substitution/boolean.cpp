// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/boolean.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/text/ascii.hpp"

namespace launch {

namespace {

constexpr std::string_view kPythonBlanks = " \t\n\r\f\v";  // the characters that str.strip() removes

// true/1 and false/0 in any case.
std::optional<bool> any_case_boolean(std::string_view text) {
  const std::string word = lower(text);
  if (word == "true" || word == "1") {
    return true;
  }
  if (word == "false" || word == "0") {
    return false;
  }
  return std::nullopt;
}

// A number as Python's float() reads it: blanks around it, `_` between digits, inf and nan; no hexadecimal.
std::optional<double> python_float(std::string_view text) {
  text = trim(text, kPythonBlanks);
  std::string digits;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto is_digit = [&](std::size_t at) {
      return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
    };
    if (text[i] != '_') {
      digits += text[i];
    } else if (i == 0 || !is_digit(i - 1) || !is_digit(i + 1)) {
      return std::nullopt;
    }
  }
  std::string_view number = digits;
  if (number.starts_with('+') && !number.starts_with("+-")) {
    number.remove_prefix(1);
  }
  if (number.find('(') != std::string_view::npos) {
    return std::nullopt;  // from_chars would take "nan(text)"
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (end != number.data() + number.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    return std::strtod(digits.c_str(), nullptr);  // infinity or zero, as in Python
  }
  return value;
}

// math.isclose() of Python with its default tolerance.
bool is_close(double left, double right) {
  if (left == right) {
    return true;
  }
  if (std::isinf(left) || std::isinf(right)) {
    return false;
  }
  return std::abs(left - right) <= 1e-9 * std::max(std::abs(left), std::abs(right));
}

}  // namespace

std::optional<bool> condition_boolean(std::string_view text) {
  return any_case_boolean(trim(text, kPythonBlanks));
}

std::optional<bool> yaml_boolean(std::string_view text) {
  constexpr std::array<std::string_view, 10> kTrue = {"1",   "true", "True", "TRUE", "yes",
                                                      "Yes", "YES",  "on",   "On",   "ON"};
  constexpr std::array<std::string_view, 10> kFalse = {"0",  "false", "False", "FALSE", "no",
                                                       "No", "NO",    "off",   "Off",   "OFF"};
  if (std::find(kTrue.begin(), kTrue.end(), text) != kTrue.end()) {
    return true;
  }
  if (std::find(kFalse.begin(), kFalse.end(), text) != kFalse.end()) {
    return false;
  }
  return std::nullopt;
}

bool launch_equal(std::string_view left, std::string_view right) {
  const std::optional<bool> left_boolean = any_case_boolean(left);
  const std::optional<bool> right_boolean = any_case_boolean(right);
  if (left_boolean && right_boolean) {
    return *left_boolean == *right_boolean;
  }
  const std::optional<double> left_number = python_float(left);
  const std::optional<double> right_number = python_float(right);
  if (left_number && right_number) {
    return is_close(*left_number, *right_number);
  }
  return left == right;
}

}  // namespace launch
