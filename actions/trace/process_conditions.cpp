// SPDX-License-Identifier: Apache-2.0
// <on_memory>, <on_overload>: visit actions when a process uses too much of the machine. The launcher looks at the
// processes itself: these conditions need no trace.
#include <fmt/format.h>

#include <chrono>

#include "actions/process/resource_settings.hpp"
#include "actions/trace/condition_rows.hpp"
#include "tracing/model/conditions/live_condition.hpp"

namespace launch {
namespace {

using tracing::LiveCondition;
using Values = HandledCondition;
using Row = ConditionRow;

constexpr Duration kUsualTime = std::chrono::seconds(5);
constexpr Duration kUsualGrowthTime = std::chrono::minutes(10);

Row process_name_row() {
  return {.attribute = {"process", AttributeType::kText, true, "",
                        "name of the process or of its node; each process of that name is looked at"},
          .perform = [](const Fields& fields, Scope& scope, Values& handled) {
            handled.event.condition.subject = LiveCondition::Subject::kProcess;
            handled.event.condition.name = fields.text("process").perform(scope);
          }};
}

Row memory_row(const char* attribute, LiveCondition::Kind kind, const char* help) {
  return {.attribute = {attribute, AttributeType::kText, false, "", help},
          .perform =
              [attribute, kind](const Fields& fields, Scope& scope, Values& handled) {
                const Template& given = fields.text(attribute);
                handled.event.condition.kind = kind;
                handled.event.condition.above = static_cast<double>(parse_bytes(given.perform(scope), given.where()));
              },
          .checks_literal = true};
}

Row share_of_processor_row() {
  return {.attribute =
              {"above", AttributeType::kText, true, "",
               "percents of one processor, such as 90%; of a process with several threads it may be more than 100%"},
          .perform =
              [](const Fields& fields, Scope& scope, Values& handled) {
                const Template& given = fields.text("above");
                handled.event.condition.above = parse_share(given.perform(scope), given.where());
              },
          .checks_literal = true};
}

void check_memory(const Fields& fields) {
  if (fields.has("above") == fields.has("growth")) {
    throw LaunchError(fields.has("above") ? "on_memory has one limit, above or growth" : "on_memory has no limit",
                      fields.has("above") ? fields.where("growth") : fields.where(),
                      fields.has("above") ? "write an on_memory for each" : "give above=\"500M\" or growth=\"50M\"",
                      fields.has("above") ? Finding::kExclusive : Finding::kMissingAttribute);
  }
  const char* const wrong = fields.has("above") ? "window" : "for";
  if (fields.has(wrong)) {
    throw LaunchError(fmt::format("{} goes with {} only", wrong, fields.has("above") ? "growth" : "above"),
                      fields.where(wrong), fields.has("above") ? "write for=\"…\"" : "write window=\"…\"",
                      Finding::kExclusive);
  }
}

}  // namespace

ActionType on_memory_action() {
  return handler_of<OnCondition>(
      "on_memory", "Visits its actions each time a process has too much memory, or gets more and more of it.",
      with_common_rows(
          {process_name_row(),
           memory_row("above", LiveCondition::Kind::kMemory, "more resident memory, in bytes, or with K, M or G"),
           memory_row("growth", LiveCondition::Kind::kGrowth,
                      "so much more than at some time in the window, in bytes, or with K, M or G"),
           window_row("for", false, "5s", "with above: for how long without a break"),
           window_row("window", false, "10min", "with growth: how far it looks back")}),
      check_memory, [](const Fields& fields, LaunchContext&, Values& handled) {
        LiveCondition& condition = handled.event.condition;
        const bool is_growth = condition.kind == LiveCondition::Kind::kGrowth;
        if (!fields.has(is_growth ? "window" : "for")) {
          condition.window = is_growth ? kUsualGrowthTime : kUsualTime;
        }
      });
}

ActionType on_overload_action() {
  return handler_of<OnCondition>(
      "on_overload", "Visits its actions each time a process has used too much of a processor for a time.",
      with_common_rows({process_name_row(), share_of_processor_row(),
                        window_row("for", false, "5s", "over which time the share is taken")}),
      nullptr, [](const Fields& fields, LaunchContext&, Values& handled) {
        LiveCondition& condition = handled.event.condition;
        condition.kind = LiveCondition::Kind::kProcessor;
        if (!fields.has("for")) {
          condition.window = kUsualTime;
        }
      });
}

}  // namespace launch
