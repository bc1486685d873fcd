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

std::string late_sentence(const LiveCondition& condition, const ConditionChange& change) {
  const bool is_topic = condition.subject == LiveCondition::Subject::kTopic;
  const bool is_node = condition.subject == LiveCondition::Subject::kNode;
  const std::string all = is_topic  ? "messages on " + condition.name
                          : is_node ? "callbacks of " + condition.name
                                    : "responses of " + condition.name;
  if (!change.holds) {
    return fmt::format("{} take no longer than {} again", all, time_text(condition.max));
  }
  const std::chrono::nanoseconds took(std::llround(change.figure * 1e9));
  if (condition.share < 1) {
    return fmt::format("{:.3g} % of the {} in {} took longer than {}, the last of them {}", 100 * change.late, all,
                       time_text(condition.window), time_text(condition.max), short_time_text(took));
  }
  return fmt::format("a {} took {}, more than {}",
                     is_topic  ? fmt::format("message on {}", condition.name)
                     : is_node ? fmt::format("callback of {}", condition.name)
                               : fmt::format("response of {}", condition.name),
                     short_time_text(took), time_text(condition.max));
}

}  // namespace

std::string short_time_text(std::chrono::nanoseconds time) {
  const auto count = static_cast<double>(time.count());
  if (count >= 1e9) {
    return fmt::format("{:.3g} s", count / 1e9);
  }
  return count >= 1e6 ? fmt::format("{:.3g} ms", count / 1e6) : fmt::format("{:.3g} us", count / 1e3);
}

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

const char* name_of(LiveCondition::Subject subject) {
  switch (subject) {
    case LiveCondition::Subject::kTopic:
      return "topic";
    case LiveCondition::Subject::kNode:
      return "node";
    case LiveCondition::Subject::kService:
      return "service";
  }
  return "";
}

std::string needs_of(const LiveCondition& condition) {
  if (condition.kind != LiveCondition::Kind::kLate || condition.subject == LiveCondition::Subject::kNode) {
    return "";
  }
  return condition.subject == LiveCondition::Subject::kTopic ? "messages" : "calls";
}

std::string describe(const LiveCondition& condition) {
  const std::string of = fmt::format("of {} {}", name_of(condition.subject), condition.name);
  if (condition.kind == LiveCondition::Kind::kSilence) {
    return fmt::format("on_silence {} for {}", of, time_text(condition.window));
  }
  if (condition.kind == LiveCondition::Kind::kLate) {
    const std::string most =
        condition.share < 1 ? fmt::format(", {:.6g} of all in {}", condition.share, time_text(condition.window)) : "";
    return fmt::format("on_late {} above {}{}", of, time_text(condition.max), most);
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
  if (condition.kind == LiveCondition::Kind::kLate) {
    return late_sentence(condition, change);
  }
  const char* const side = condition.below ? "below" : "above";
  const double limit = condition.below ? *condition.below : condition.above.value_or(0);
  return fmt::format("{:.4g} messages/s on {} in {}, {} {} {:.4g}", change.figure, condition.name,
                     time_text(condition.window), change.holds ? "which is" : "no longer", side, limit);
}

}  // namespace tracing
