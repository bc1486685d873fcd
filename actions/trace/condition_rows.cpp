// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/condition_rows.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "tracing/model/conditions/live_condition.hpp"

namespace launch {
namespace {

constexpr Duration kShortestWindow = std::chrono::milliseconds(100);

}  // namespace

Duration perform_time_with_unit(const char* attribute, const Fields& fields, Scope& scope, Duration least) {
  const Template& given = fields.text(attribute);
  const std::string text = given.perform(scope);
  const std::optional<Duration> time = tracing::parse_time_text(text);
  if (!time) {
    const bool lacks_unit = tracing::parse_time_text(text + "s").has_value();
    throw LaunchError(fmt::format("{} is a time with a unit, got '{}'", attribute, text), given.where(),
                      lacks_unit ? fmt::format("did you mean '{}s'? Units are us, ms, s and min", text)
                                 : "write it as 2s, 500ms or 1min");
  }
  if (*time < least) {
    throw LaunchError(fmt::format("{} is at least {}, got '{}'", attribute, tracing::time_text(least), text),
                      given.where(), fmt::format("write {} or more", tracing::time_text(least)));
  }
  return *time;
}

ConditionRow window_row(const char* attribute, bool required, const char* fallback, const char* help) {
  return {.attribute = {attribute, AttributeType::kText, required, fallback, help},
          .perform =
              [attribute](const Fields& fields, Scope& scope, HandledCondition& handled) {
                handled.event.condition.window = perform_time_with_unit(attribute, fields, scope, kShortestWindow);
              },
          .checks_literal = true};
}

HandlerRows<OnCondition> with_common_rows(HandlerRows<OnCondition> rows) {
  rows.push_back({.attribute = {"cool_down", AttributeType::kText, false, "0s", "the least time between two visits"},
                  .perform =
                      [](const Fields& fields, Scope& scope, HandledCondition& handled) {
                        handled.event.cool_down = perform_time_with_unit("cool_down", fields, scope, Duration(0));
                      },
                  .checks_literal = true});
  rows.push_back({.attribute = {"grace", AttributeType::kText, false, "10s",
                                "if nothing of the launch has the name until then, a warning says so"},
                  .perform =
                      [](const Fields& fields, Scope& scope, HandledCondition& handled) {
                        handled.event.condition.grace = perform_time_with_unit("grace", fields, scope, Duration(0));
                      },
                  .checks_literal = true});
  rows.push_back(once_row<OnCondition>());
  rows.push_back(handler_name_row<OnCondition>());
  return rows;
}

}  // namespace launch
