// SPDX-License-Identifier: Apache-2.0
#include "actions/process/resource_settings.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace launch {

namespace {

constexpr std::int64_t kMostUrgent = -20;
constexpr std::int64_t kLeastUrgent = 19;
constexpr std::int64_t kHighestPriority = 99;
constexpr std::int64_t kLeastOpenFiles = 3;  // the standard streams

std::int64_t bounded(const Fields& fields, const char* name, Scope& scope, std::int64_t least, std::int64_t most) {
  const auto value = static_cast<std::int64_t>(fields.number(name)->perform(scope));
  if (value < least || value > most) {
    throw LaunchError(most == std::numeric_limits<int>::max()
                          ? fmt::format("{} is at least {}, got {}", name, least, value)
                          : fmt::format("{} is a number from {} to {}, got {}", name, least, most, value),
                      fields.where(name));
  }
  return value;
}

template <typename Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && result.ec == std::errc() && result.ptr == text.data() + text.size();
}

// "0,2-3"
std::vector<int> parse_cpus(const std::string& text, const SourceRange& where) {
  std::vector<int> cpus;
  const std::string_view view = text;
  for (std::size_t begin = 0; begin <= view.size();) {
    const std::size_t end = std::min(view.find(',', begin), view.size());
    const std::string_view range = view.substr(begin, end - begin);
    const std::size_t dash = std::min(range.find('-'), range.size());
    int first = 0;
    int last = 0;
    if (!parse_whole(range.substr(0, dash), first) ||
        !parse_whole(dash == range.size() ? range : range.substr(dash + 1), last) || first < 0 || last < first ||
        last >= CPU_SETSIZE) {
      throw LaunchError(fmt::format("'{}' is no list of CPUs", text), where, "write numbers and ranges, such as 0,2-3");
    }
    for (int cpu = first; cpu <= last; ++cpu) {
      cpus.push_back(cpu);
    }
    begin = end + 1;
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

bool is_real_time(const ResourceLimits& limits) {
  return limits.policy == SCHED_FIFO || limits.policy == SCHED_RR;
}

void perform_policy(const Fields& fields, Scope& scope, ResourceLimits& limits) {
  const SourceRange& where = fields.where("sched_policy");
  const std::string name = fields.text("sched_policy").perform(scope);
  limits.policy = scheduling_policy(name);
  if (!limits.policy) {
    throw LaunchError(fmt::format("'{}' is no scheduling policy, expected other, batch, idle, fifo or rr", name), where,
                      did_you_mean(name, {"other", "batch", "idle", "fifo", "rr"}));
  }
  if (is_real_time(limits) && !fields.has("sched_priority")) {
    throw LaunchError(fmt::format("the policy {} needs a priority", scheduling_policy_name(*limits.policy)), where,
                      "add sched_priority, from 1 to 99", Finding::kMissingAttribute);
  }
}

void perform_priority(const Fields& fields, Scope& scope, ResourceLimits& limits) {
  if (!is_real_time(limits)) {
    throw LaunchError("sched_priority goes with the policies fifo and rr only", fields.where("sched_priority"),
                      "add sched_policy=\"fifo\", or use nice", Finding::kExclusive);
  }
  limits.priority = static_cast<int>(bounded(fields, "sched_priority", scope, 1, kHighestPriority));
}

}  // namespace

std::uint64_t parse_bytes(const std::string& text, const SourceRange& where) {
  std::string_view digits = text;
  unsigned shift = 0;
  if (!digits.empty()) {
    constexpr std::string_view kUnits = "KMG";
    if (const std::size_t unit = kUnits.find(digits.back()); unit != std::string_view::npos) {
      shift = static_cast<unsigned>(unit + 1) * 10;
      digits.remove_suffix(1);
    }
  }
  std::uint64_t value = 0;
  if (!parse_whole(digits, value) || value == 0 || value > (std::numeric_limits<std::uint64_t>::max() >> shift)) {
    throw LaunchError(fmt::format("'{}' is no amount of memory", text), where,
                      "write bytes, or a number with K, M or G");
  }
  return value << shift;
}

const std::vector<Setting<ResourceLimits>>& resource_settings() {
  static const std::vector<Setting<ResourceLimits>> settings = {
      {.attribute = {"nice", AttributeType::kInteger, false, "the launcher's", "niceness, from -20 (urgent) to 19",
                     true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.niceness = bounded(fields, "nice", scope, kMostUrgent, kLeastUrgent);
           }},
      {.attribute = {"sched_policy", AttributeType::kText, false, "the launcher's", "other, batch, idle, fifo or rr",
                     true},
       .perform = perform_policy},
      {.attribute = {"sched_priority", AttributeType::kInteger, false, "", "with fifo and rr: 1 to 99 (urgent)", true},
       .perform = perform_priority},
      {.attribute = {"cpus", AttributeType::kText, false, "the launcher's",
                     "CPUs that the process may run on, such as 0,2-3", true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.cpus = parse_cpus(fields.text("cpus").perform(scope), fields.where("cpus"));
           },
       .checks_literal = true},
      {.attribute = {"memory_limit", AttributeType::kText, false, "none", "private memory in bytes, or with K, M or G",
                     true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.memory = parse_bytes(fields.text("memory_limit").perform(scope), fields.where("memory_limit"));
           },
       .checks_literal = true},
      {.attribute = {"open_files_limit", AttributeType::kInteger, false, "the launcher's",
                     "how many descriptors the process may have", true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.open_files =
                 bounded(fields, "open_files_limit", scope, kLeastOpenFiles, std::numeric_limits<int>::max());
           }},
  };
  return settings;
}

}  // namespace launch
