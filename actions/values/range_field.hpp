// SPDX-License-Identifier: Apache-2.0
// An attribute of a fault that is a number or a range of numbers, from which one is drawn: at="1..5".
#pragma once

#include <optional>
#include <string>

#include "launcher/language/fields.hpp"
#include "launcher/visit/fault_draw.hpp"

namespace launch {

class RangeField {
 public:
  // The attribute must be of type kText. nullopt if it is not given. Throws LaunchError for a literal that is wrong.
  static std::optional<RangeField> of(const Fields& fields, const std::string& attribute, bool whole = false,
                                      bool may_be_negative = false);

  // Numbers are not negative unless they may be, and from 1 if they are whole. Throws LaunchError.
  NumberRange perform(Scope& scope) const { return parse(text_.perform(scope)); }
  const std::string& attribute() const { return attribute_; }
  const SourceRange& where() const { return text_.where(); }

 private:
  RangeField(std::string attribute, Template text, bool whole, bool may_be_negative)
      : attribute_(std::move(attribute)), text_(std::move(text)), whole_(whole), may_be_negative_(may_be_negative) {}
  NumberRange parse(const std::string& text) const;
  double number(std::string_view text) const;

  std::string attribute_;
  Template text_;
  bool whole_;
  bool may_be_negative_;
};

}  // namespace launch
