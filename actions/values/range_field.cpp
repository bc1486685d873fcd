// SPDX-License-Identifier: Apache-2.0
#include "actions/values/range_field.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/text/ascii.hpp"

namespace launch {

namespace {

double number_of(const std::string& attribute, std::string_view text, RangeOf numbers, const SourceRange& where) {
  const std::string_view digits = trim(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
  constexpr double kMost = 1e9;
  const bool whole = numbers == RangeOf::kWholeNumbersFromOne;
  const double least = whole ? 1 : numbers == RangeOf::kNumbers ? -kMost : 0;
  if (!is_number || value < least || value > kMost || (whole && value != std::floor(value))) {
    throw LaunchError(fmt::format("{} takes {}, got '{}'", attribute,
                                  whole                          ? "a whole number from 1"
                                  : numbers == RangeOf::kNumbers ? "a number"
                                                                 : "a number that is not negative",
                                  text),
                      where, "or a range of them, such as 1..5", Finding::kWrongType);
  }
  return value;
}

}  // namespace

NumberRange perform_range(const Fields& fields, const std::string& attribute, Scope& scope, RangeOf numbers) {
  const SourceRange& where = fields.text(attribute).where();
  const std::string text = fields.text(attribute).perform(scope);
  const std::string_view all = text;
  const std::size_t dots = all.find("..");
  if (dots == std::string_view::npos) {
    const double value = number_of(attribute, all, numbers, where);
    return {value, value};
  }
  const double from = number_of(attribute, all.substr(0, dots), numbers, where);
  const double to = number_of(attribute, all.substr(dots + 2), numbers, where);
  if (to < from) {
    throw LaunchError(fmt::format("the range of {} begins behind its end: '{}'", attribute, text), where, {},
                      Finding::kWrongType);
  }
  return {from, to};
}

void check_range(const Fields& fields, const std::string& attribute, RangeOf numbers) {
  if (Scope nothing; fields.has(attribute) && fields.text(attribute).is_literal()) {
    perform_range(fields, attribute, nothing, numbers);
  }
}

}  // namespace launch
