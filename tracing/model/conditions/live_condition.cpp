// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/conditions/live_condition.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

std::string needs_of(const LiveCondition& condition) {
  using Subject = LiveCondition::Subject;
  if (condition.kind == LiveCondition::Kind::kLoss) {
    return "losses";
  }
  if (condition.kind != LiveCondition::Kind::kLate) {
    return "";
  }
  switch (condition.subject) {
    case Subject::kTopic:
    case Subject::kChain:
      return "messages";
    case Subject::kService:
    case Subject::kAction:
      return "calls";
    case Subject::kNode:
    case Subject::kTimer:
    case Subject::kProcess:
      break;
  }
  return "";
}

std::optional<std::vector<std::string>> nodes_of_chain(std::string_view chain) {
  constexpr std::string_view kSpaces = " \t\n";
  std::vector<std::string> nodes;
  while (true) {
    const std::size_t arrow = chain.find("->");
    std::string_view node = chain.substr(0, arrow);
    node.remove_prefix(std::min(node.find_first_not_of(kSpaces), node.size()));
    node = node.substr(0, node.find_last_not_of(kSpaces) + 1);
    if (node.empty() || node.find_first_of(kSpaces) != std::string_view::npos) {
      return std::nullopt;
    }
    nodes.emplace_back(node);
    if (arrow == std::string_view::npos) {
      break;
    }
    chain.remove_prefix(arrow + 2);
  }
  return nodes.size() < 2 ? std::nullopt : std::optional(std::move(nodes));
}

std::string chain_of_nodes(const std::vector<std::string>& nodes) {
  return fmt::format("{}", fmt::join(nodes, " -> "));
}

}  // namespace tracing
