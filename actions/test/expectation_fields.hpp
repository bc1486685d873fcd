// SPDX-License-Identifier: Apache-2.0
// What the items of <test> have in common.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The declarations.
AttributeSpec own_attribute(std::string name, AttributeType type, bool required, std::string fallback,
                            std::string help);
AttributeSpec process_attribute(bool required);
ItemSpec expectation_item(std::string tag, std::string help, std::vector<AttributeSpec> attributes);

// The number of an attribute, if it is given. Throws LaunchError for a literal below zero.
std::optional<NumberField> from_zero(const Fields& fields, const char* attribute);

Duration as_duration(double seconds);

// A time that an attribute gives in seconds, or in milliseconds.
class TimeField {
 public:
  static constexpr double kSecond = 1;
  static constexpr double kMillisecond = 1e-3;

  // nullopt if it is not given. Throws LaunchError for a literal that is no time.
  static std::optional<TimeField> of(const Fields& fields, const char* attribute, double unit = kSecond);

  // Throws LaunchError, also above a billion seconds, which the clock can't count.
  Duration perform(Scope& scope) const;
  const SourceRange& where() const { return where_; }

 private:
  TimeField(NumberField number, SourceRange where, double unit)
      : number_(std::move(number)), where_(std::move(where)), unit_(unit) {}

  NumberField number_;
  SourceRange where_;
  double unit_;
};

// The process that an item speaks of, and the time that it gives.
class ExpectationSubject {
 public:
  explicit ExpectationSubject(const Fields& fields);
  const SourceRange& where() const { return where_; }

  template <typename What>
  Expectation of(What what, Scope& scope) const {
    Expectation expectation = perform(scope);
    expectation.what = std::move(what);
    return expectation;
  }

 private:
  Expectation perform(Scope& scope) const;

  SourceRange where_;
  std::optional<Template> process_;
  std::optional<TimeField> within_;
};

}  // namespace launch
