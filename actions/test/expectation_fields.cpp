// SPDX-License-Identifier: Apache-2.0
#include "actions/test/expectation_fields.hpp"

#include <fmt/format.h>

#include <chrono>

namespace launch {

AttributeSpec own_attribute(std::string name, AttributeType type, bool required, std::string fallback,
                            std::string help) {
  return {std::move(name), type, required, std::move(fallback), std::move(help), true};
}

AttributeSpec process_attribute(bool required) {
  return own_attribute("process", AttributeType::kText, required, required ? "" : "every process",
                       "a process, by its name or that of its node");
}

ItemSpec expectation_item(std::string tag, std::string help, std::vector<AttributeSpec> attributes) {
  return {.tag = std::move(tag),
          .help = std::move(help),
          .attributes = std::move(attributes),
          .has_condition = true,
          .extension = true};
}

std::optional<NumberField> from_zero(const Fields& fields, const char* attribute) {
  std::optional<NumberField> number = fields.number(attribute);
  if (number) {
    number->require_not_negative();
  }
  return number;
}

Duration as_duration(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

std::optional<TimeField> TimeField::of(const Fields& fields, const char* attribute, double unit) {
  std::optional<NumberField> number = from_zero(fields, attribute);
  return number ? std::optional(TimeField(*std::move(number), fields.where(attribute), unit)) : std::nullopt;
}

Duration TimeField::perform(Scope& scope) const {
  constexpr double kMost = 1e9;
  const double seconds = number_.perform(scope) * unit_;
  if (!(seconds <= kMost)) {
    throw LaunchError(fmt::format("a time of {:g} s is too long", seconds), where_, "a billion seconds at most",
                      Finding::kWrongValue);
  }
  return as_duration(seconds);
}

ExpectationSubject::ExpectationSubject(const Fields& fields)
    : where_(fields.where()), process_(fields.optional_text("process")), within_(TimeField::of(fields, "within")) {}

Expectation ExpectationSubject::perform(Scope& scope) const {
  Expectation expectation;
  expectation.where = where_;
  expectation.process_where = where_;
  if (process_) {
    expectation.process = process_->perform(scope);
    expectation.process_where = process_->where();
  }
  if (within_) {
    expectation.within = within_->perform(scope);
  }
  return expectation;
}

}  // namespace launch
