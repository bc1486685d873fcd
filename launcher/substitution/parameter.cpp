// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/parameter.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launch {

namespace {

// The shortest digits that read back as the same number; an exponent from 1e16 on and below 1e-4.
std::string python_float(double value) {
  if (std::isnan(value)) {
    return "nan";
  }
  if (std::isinf(value)) {
    return value > 0 ? "inf" : "-inf";
  }
  std::string digits = fmt::format("{}", value);
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

std::string python_scalar(const ParameterScalar& scalar, bool quote) {
  if (const bool* const boolean = std::get_if<bool>(&scalar)) {
    return *boolean ? "True" : "False";
  }
  if (const std::int64_t* const number = std::get_if<std::int64_t>(&scalar)) {
    return fmt::format("{}", *number);
  }
  if (const double* const number = std::get_if<double>(&scalar)) {
    return python_float(*number);
  }
  if (const std::byte* const byte = std::get_if<std::byte>(&scalar)) {
    return fmt::format("b'\\x{:02x}'", std::to_integer<unsigned>(*byte));
  }
  const std::string& text = std::get<std::string>(scalar);
  return quote ? fmt::format("'{}'", text) : text;
}

}  // namespace

std::string to_python_text(const ParameterValue& value) {
  if (const auto* const scalar = std::get_if<ParameterScalar>(&value)) {
    return python_scalar(*scalar, false);
  }
  const auto& items = std::get<std::vector<ParameterScalar>>(value);
  std::string text;
  for (const ParameterScalar& item : items) {
    text += (text.empty() ? "" : ", ") + python_scalar(item, true);
  }
  return items.size() == 1 ? "(" + text + ",)" : "(" + text + ")";
}

}  // namespace launch
