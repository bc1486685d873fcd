// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/conditions/live_condition.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace tracing {
namespace {

struct TimeUnit {
  std::string_view name;
  double nanoseconds;
};
// A unit stands before those that its name ends with.
constexpr std::array<TimeUnit, 4> kTimeUnits{{{"min", 60e9}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};
constexpr double kLongestTime = 365 * 86400e9;

}  // namespace

std::string time_text(std::chrono::nanoseconds time) {
  const auto count = static_cast<double>(time.count());
  if (count >= 1e9) {
    return fmt::format("{:.10g}s", count / 1e9);
  }
  return count >= 1e6 ? fmt::format("{:.7g}ms", count / 1e6) : fmt::format("{:.4g}us", count / 1e3);
}

std::optional<std::chrono::nanoseconds> parse_time_text(const std::string& text) {
  for (const TimeUnit& unit : kTimeUnits) {
    if (!text.ends_with(unit.name)) {
      continue;
    }
    std::string_view number = std::string_view(text).substr(0, text.size() - unit.name.size());
    while (number.ends_with(' ')) {
      number.remove_suffix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size() || !std::isfinite(value) || value < 0 ||
        value * unit.nanoseconds > kLongestTime) {
      return std::nullopt;
    }
    return std::chrono::nanoseconds(std::llround(value * unit.nanoseconds));
  }
  return std::nullopt;
}

std::string describe(const LiveCondition& condition) {
  const std::string of =
      fmt::format("of {} {}", condition.subject == LiveCondition::Subject::kTopic ? "topic" : "node", condition.name);
  if (condition.kind == LiveCondition::Kind::kSilence) {
    return fmt::format("on_silence {} for {}", of, time_text(condition.window));
  }
  return fmt::format("on_rate {} {} {:.4g} Hz in {}", of, condition.below ? "below" : "above",
                     condition.below ? *condition.below : condition.above.value_or(0), time_text(condition.window));
}

std::string sentence(const LiveCondition& condition, const ConditionChange& change) {
  const bool is_topic = condition.subject == LiveCondition::Subject::kTopic;
  if (condition.kind == LiveCondition::Kind::kSilence) {
    if (change.holds) {
      return is_topic ? fmt::format("no message on {} for {:.3g} s", condition.name, change.figure)
                      : fmt::format("no callback of {} has ended for {:.3g} s", condition.name, change.figure);
    }
    return fmt::format("the silence of {} is over after {:.3g} s", condition.name, change.figure);
  }
  const char* const side = condition.below ? "below" : "above";
  const double limit = condition.below ? *condition.below : condition.above.value_or(0);
  return fmt::format("{:.4g} messages/s on {} in {}, {} {} {:.4g}", change.figure, condition.name,
                     time_text(condition.window), change.holds ? "which is" : "no longer", side, limit);
}

}  // namespace tracing
