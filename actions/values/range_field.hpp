// SPDX-License-Identifier: Apache-2.0
// An attribute of a fault that is a number or a range of numbers, from which one is drawn: at="1..5".
#pragma once

#include <string>
#include <utility>

#include "launcher/language/setting.hpp"
#include "launcher/visit/fault_draw.hpp"

namespace launch {

enum class RangeOf { kNumbersFromZero, kNumbers, kWholeNumbersFromOne };

// The attribute must be given, and of type kText. Throws LaunchError.
NumberRange perform_range(const Fields& fields, const std::string& attribute, Scope& scope,
                          RangeOf numbers = RangeOf::kNumbersFromZero);
// Throws LaunchError for a literal that is wrong. The attribute may be missing.
void check_range(const Fields& fields, const std::string& attribute, RangeOf numbers = RangeOf::kNumbersFromZero);

// The row of such an attribute, whose value goes to a member: a range, or an optional one.
template <typename Target, typename Range>
Setting<Target> range_row(AttributeSpec attribute, Range Target::*member, RangeOf numbers = RangeOf::kNumbersFromZero) {
  std::string name = attribute.name;
  return {.attribute = std::move(attribute),
          .perform = [name = std::move(name), member, numbers](
                         const Fields& fields, Scope& scope,
                         Target& target) { target.*member = perform_range(fields, name, scope, numbers); },
          .checks_literal = true};
}

}  // namespace launch
