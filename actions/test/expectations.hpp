// SPDX-License-Identifier: Apache-2.0
// The items of <test> that say what must happen, and what they have in common.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "launcher/language/setting.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// Evaluates an item in the current scope. Throws LaunchError.
using PerformExpectation = std::function<Expectation(LaunchContext&)>;

struct ExpectationType {
  ItemSpec item;
  // Throws LaunchError when attributes don't go together.
  std::function<PerformExpectation(const Fields&)> make;
};

const std::vector<ExpectationType>& expectation_types();
ExpectationType message_expectation_type();
// Those of them that speak of the trace of the run (trace_expectations.cpp).
std::vector<ExpectationType> trace_expectation_types();

// The declarations.
AttributeSpec own_attribute(std::string name, AttributeType type, bool required, std::string fallback,
                            std::string help);
AttributeSpec process_attribute(bool required);
AttributeSpec within_attribute(std::string help = "seconds from the begin of the test");
ItemSpec expectation_item(std::string tag, std::string help, std::vector<AttributeSpec> attributes);

// The process that an item speaks of, and the time that it gives: the attributes `process` and `within`, if it has
// them. The first throws LaunchError for literals that are wrong.
void check_subject(const Fields& fields);
Expectation perform_subject(const Fields& fields, Scope& scope);

inline constexpr double kSecond = 1;
inline constexpr double kMillisecond = 1e-3;

// The time that an attribute gives in these units. Throws LaunchError, also above a billion seconds, which the clock
// can't count.
Duration perform_time(const Fields& fields, const std::string& attribute, Scope& scope, double unit);

// The row of such an attribute.
template <typename Target, typename Time>
Setting<Target> time_row(AttributeSpec attribute, Time Target::*member, double unit = kSecond) {
  const std::string name = attribute.name;
  return {.attribute = std::move(attribute),
          .place = place_of(member),
          .perform = [name, member, unit](const Fields& fields, Scope& scope, Target& target) {
            target.*member = perform_time(fields, name, scope, unit);
          }};
}

// The row of a number of things, which must not be negative.
template <typename Target, typename Count>
Setting<Target> count_row(std::string name, std::string fallback, std::string help, Count Target::*member) {
  return {
      .attribute = own_attribute(std::move(name), AttributeType::kInteger, false, std::move(fallback), std::move(help)),
      .place = place_of(member)};
}

template <typename Expected>
using Rows = std::vector<Setting<Expected>>;

// An item that its rows tell. `check` says what is wrong with the fields together, `finish` with their values.
template <typename Expected>
ExpectationType expectation_of(std::string tag, std::string help, Rows<Expected> given,
                               void (*check)(const Fields&) = nullptr,
                               void (*finish)(const Fields&, LaunchContext&, Expected&) = nullptr) {
  const auto rows = std::make_shared<const Rows<Expected>>(std::move(given));
  return {expectation_item(std::move(tag), std::move(help), declared_attributes(*rows)),
          [=](const Fields& fields) -> PerformExpectation {
            check_subject(fields);
            if (check != nullptr) {
              check(fields);
            }
            check_settings(*rows, fields);
            return [=](LaunchContext& context) {
              Expected expected{};
              perform_settings(*rows, fields, context.scope(), expected);
              if (finish != nullptr) {
                finish(fields, context, expected);
              }
              Expectation expectation = perform_subject(fields, context.scope());
              if constexpr (std::is_constructible_v<TraceExpectation, Expected>) {
                expectation.what = TraceExpectation(std::move(expected));
              } else {
                expectation.what = std::move(expected);
              }
              return expectation;
            };
          }};
}

}  // namespace launch
