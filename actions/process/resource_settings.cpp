// SPDX-License-Identifier: Apache-2.0
#include "actions/process/resource_settings.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <charconv>
#include <chrono>
#include <limits>
#include <optional>
#include <string_view>

#include "base/text/byte_size.hpp"

namespace launch {

namespace {

constexpr std::int64_t kMostUrgent = -20;
constexpr std::int64_t kLeastUrgent = 19;
constexpr std::int64_t kHighestPriority = 99;
constexpr std::int64_t kMostOomScore = 1000;
constexpr std::chrono::nanoseconds kLeastRuntime{1024};  // the kernel takes no less
constexpr std::int64_t kLeastOpenFiles = 3;              // the standard streams

std::int64_t bounded(const Fields& fields, const char* name, Scope& scope, std::int64_t least, std::int64_t most) {
  const auto value = static_cast<std::int64_t>(fields.number(name)->perform(scope));
  if (value < least || value > most) {
    throw LaunchError(most == std::numeric_limits<int>::max() && value < least
                          ? fmt::format("{} is at least {}, got {}", name, least, value)
                          : fmt::format("{} is a number from {} to {}, got {}", name, least, most, value),
                      fields.where(name));
  }
  return value;
}

std::vector<int> parse_cpus(const std::string& text, const SourceRange& where) {
  std::optional<std::vector<int>> cpus = parse_cpu_list(text);
  if (!cpus) {
    throw LaunchError(fmt::format("'{}' is no list of CPUs", text), where, "write numbers and ranges, such as 0,2-3");
  }
  return *std::move(cpus);
}

bool is_real_time(const ResourceLimits& limits) {
  return limits.policy == SCHED_FIFO || limits.policy == SCHED_RR;
}

void perform_policy(const Fields& fields, Scope& scope, ResourceLimits& limits) {
  const SourceRange& where = fields.where("sched_policy");
  const std::string name = fields.text("sched_policy").perform(scope);
  limits.policy = scheduling_policy(name);
  if (!limits.policy) {
    throw LaunchError(
        fmt::format("'{}' is no scheduling policy, expected other, batch, idle, fifo, rr or deadline", name), where,
        did_you_mean(name, {"other", "batch", "idle", "fifo", "rr", "deadline"}));
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

// Seconds, of which the kernel wants whole nanoseconds.
template <std::chrono::nanoseconds DeadlineSchedule::*Member>
Setting<ResourceLimits> schedule_setting(const char* name, const char* fallback, const char* help) {
  return {.attribute = {name, AttributeType::kFloat, false, fallback, help, true},
          .place = [](ResourceLimits& limits) -> SettingPlace { return &(limits.schedule.*Member); }};
}

void perform_timer_slack(const Fields& fields, Scope& scope, ResourceLimits& limits) {
  const auto slack = as_duration(fields.number("timer_slack")->perform(scope));
  if (slack < std::chrono::nanoseconds(1) || slack > std::chrono::seconds(1)) {
    throw LaunchError(fmt::format("timer_slack is a time from 0.000000001 to 1 second, got {}",
                                  fields.number("timer_slack")->perform(scope)),
                      fields.where("timer_slack"));
  }
  limits.timer_slack = slack;
}

void perform_locked_memory(const Fields& fields, Scope& scope, ResourceLimits& limits) {
  const std::string text = fields.text("locked_memory_limit").perform(scope);
  limits.locked_memory =
      text == "unlimited" ? kUnlimited : parse_bytes(text, fields.where("locked_memory_limit"), ", or unlimited");
}

void check_deadline(const Fields& fields, const DeadlineSchedule& schedule) {
  for (const char* const needed : {"sched_runtime", "sched_deadline"}) {
    if (!fields.has(needed)) {
      throw LaunchError(fmt::format("the policy deadline needs a {}", needed), fields.where("sched_policy"),
                        "add sched_runtime and sched_deadline, in seconds", Finding::kMissingAttribute);
    }
  }
  for (const char* const other : {"cpus", "nice"}) {
    if (fields.has(other)) {
      throw LaunchError(fmt::format("{} does not go with the policy deadline", other), fields.where(other),
                        other == std::string_view("cpus")
                            ? "a thread with this policy runs on all CPUs of its cpuset; make a cpuset for it"
                            : "what is urgent follows from the deadline",
                        Finding::kExclusive);
    }
  }
  const auto seconds = [](std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); };
  if (schedule.runtime < kLeastRuntime) {
    throw LaunchError(
        fmt::format("sched_runtime is at least {:f} s, got {}", seconds(kLeastRuntime), seconds(schedule.runtime)),
        fields.where("sched_runtime"));
  }
  if (schedule.deadline < schedule.runtime) {
    throw LaunchError(fmt::format("the deadline of {} s is shorter than the runtime of {} s",
                                  seconds(schedule.deadline), seconds(schedule.runtime)),
                      fields.where("sched_deadline"));
  }
  if (fields.has("sched_period") && schedule.period < schedule.deadline) {
    throw LaunchError(fmt::format("the period of {} s is shorter than the deadline of {} s", seconds(schedule.period),
                                  seconds(schedule.deadline)),
                      fields.where("sched_period"), "leave it out to have that of the deadline");
  }
}

}  // namespace

void check_resources(const Fields& fields, const ResourceLimits& limits) {
  if (limits.policy == kDeadlinePolicy) {
    check_deadline(fields, limits.schedule);
    return;
  }
  for (const char* const of_deadline : {"sched_runtime", "sched_deadline", "sched_period"}) {
    if (fields.has(of_deadline)) {
      throw LaunchError(fmt::format("{} goes with the policy deadline only", of_deadline), fields.where(of_deadline),
                        "add sched_policy=\"deadline\"", Finding::kExclusive);
    }
  }
}

std::uint64_t parse_bytes(const std::string& text, const SourceRange& where, const char* or_else) {
  const std::optional<std::uint64_t> size = parse_byte_size(text);
  if (!size || *size == 0) {
    throw LaunchError(fmt::format("'{}' is no amount of memory", text), where,
                      fmt::format("write bytes, or a number with K, M or G{}", or_else));
  }
  return *size;
}

double parse_share(const std::string& text, const SourceRange& where) {
  double percent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
  constexpr double kLeast = 1;  // the kernel takes no less than a millisecond of a period
  constexpr double kMost = 1e6;
  if (error != std::errc() || std::string_view(end, text.data() + text.size()) != "%" || !(percent >= kLeast) ||
      percent > kMost) {
    throw LaunchError(fmt::format("'{}' is no share of a processor", text), where,
                      "write percents of one processor, from 1% on, such as 50% or 150%");
  }
  return percent / 100;
}

const std::vector<Setting<ResourceLimits>>& resource_settings() {
  static const std::vector<Setting<ResourceLimits>> settings = {
      {.attribute = {"nice", AttributeType::kInteger, false, "the launcher's", "niceness, from -20 (urgent) to 19",
                     true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.niceness = bounded(fields, "nice", scope, kMostUrgent, kLeastUrgent);
           }},
      {.attribute = {"sched_policy", AttributeType::kText, false, "the launcher's",
                     "other, batch, idle, fifo, rr or deadline", true},
       .perform = perform_policy},
      {.attribute = {"sched_priority", AttributeType::kInteger, false, "", "with fifo and rr: 1 to 99 (urgent)", true},
       .perform = perform_priority},
      schedule_setting<&DeadlineSchedule::runtime>(
          "sched_runtime", "", "with deadline: seconds of a processor that the main thread gets in each period"),
      schedule_setting<&DeadlineSchedule::deadline>(
          "sched_deadline", "", "with deadline: seconds from the beginning of a period in which it gets them"),
      schedule_setting<&DeadlineSchedule::period>("sched_period", "sched_deadline",
                                                  "with deadline: seconds from one period to the next"),
      {.attribute = {"timer_slack", AttributeType::kFloat, false, "the launcher's",
                     "seconds by which the kernel may lengthen a sleep, to save wake-ups; 0.00005 is usual", true},
       .perform = perform_timer_slack},
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
      {.attribute = {"locked_memory_limit", AttributeType::kText, false, "the launcher's",
                     "memory that the process may lock by mlockall(2), in bytes, or with K, M or G, or unlimited; it "
                     "must do that itself",
                     true},
       .perform = perform_locked_memory,
       .checks_literal = true},
      {.attribute = {"oom_score_adj", AttributeType::kInteger, false, "the launcher's",
                     "-1000 to 1000: whom the kernel ends when there is no memory, 1000 first, -1000 never", true},
       .perform =
           [](const Fields& fields, Scope& scope, ResourceLimits& limits) {
             limits.oom_score_adj =
                 static_cast<int>(bounded(fields, "oom_score_adj", scope, -kMostOomScore, kMostOomScore));
           }},
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
