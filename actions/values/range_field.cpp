// SPDX-License-Identifier: Apache-2.0
#include "actions/values/range_field.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/text/ascii.hpp"

namespace launch {

std::optional<RangeField> RangeField::of(const Fields& fields, const std::string& attribute, bool whole,
                                         bool may_be_negative) {
  std::optional<Template> text = fields.optional_text(attribute);
  if (!text) {
    return std::nullopt;
  }
  RangeField field(attribute, *std::move(text), whole, may_be_negative);
  if (field.text_.is_literal()) {
    Scope nothing;
    field.perform(nothing);
  }
  return field;
}

NumberRange RangeField::parse(const std::string& text) const {
  const std::string_view all = text;
  const std::size_t dots = all.find("..");
  if (dots == std::string_view::npos) {
    const double value = number(all);
    return {value, value};
  }
  const NumberRange range{number(all.substr(0, dots)), number(all.substr(dots + 2))};
  if (range.to < range.from) {
    throw LaunchError(fmt::format("the range of {} begins behind its end: '{}'", attribute_, text), where(), {},
                      Finding::kWrongType);
  }
  return range;
}

double RangeField::number(std::string_view text) const {
  const std::string_view digits = trim(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
  constexpr double kMost = 1e9;
  const double least = whole_ ? 1 : may_be_negative_ ? -kMost : 0;
  if (!is_number || value < least || value > kMost || (whole_ && value != std::floor(value))) {
    throw LaunchError(fmt::format("{} takes {}, got '{}'", attribute_,
                                  whole_             ? "a whole number from 1"
                                  : may_be_negative_ ? "a number"
                                                     : "a number that is not negative",
                                  text),
                      where(), "or a range of them, such as 1..5", Finding::kWrongType);
  }
  return value;
}

}  // namespace launch
