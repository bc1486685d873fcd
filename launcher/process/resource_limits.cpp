// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/resource_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "launcher/process/exec/launch_exec_protocol.hpp"

namespace launch {

namespace {

constexpr std::array<std::pair<int, const char*>, 6> kPolicies{{{SCHED_OTHER, "other"},
                                                                {SCHED_BATCH, "batch"},
                                                                {SCHED_IDLE, "idle"},
                                                                {SCHED_FIFO, "fifo"},
                                                                {SCHED_RR, "rr"},
                                                                {kDeadlinePolicy, "deadline"}}};

// Tells a user who is not root how to get a right that pam_limits gives.
std::string how_to_permit(const char* item, long value) {
  return fmt::format(
      "add the line `{} - {} {}` to a file in /etc/security/limits.d and log in again, or give the launcher "
      "the capability CAP_SYS_NICE",
      ::getuid() == 0 ? "root" : "YOUR_USER", item, value);
}

std::optional<int> cpu_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::string bytes_text(std::uint64_t bytes) {
  return bytes == kUnlimited ? "any amount" : fmt::format("{} bytes", bytes);
}

std::string schedule_text(const DeadlineSchedule& schedule) {
  const auto seconds = [](std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); };
  return fmt::format("{} s of a processor within {} s in each {} s", seconds(schedule.runtime),
                     seconds(schedule.deadline),
                     seconds(schedule.period.count() == 0 ? schedule.deadline : schedule.period));
}

std::string hard_limit(__rlimit_resource_t resource) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  return limit.rlim_max == RLIM_INFINITY ? "unlimited" : fmt::format("{}", limit.rlim_max);
}

}  // namespace

std::vector<int> allowed_cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  std::vector<int> cpus;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) {
      cpus.push_back(cpu);
    }
  }
  return cpus;
}

std::string scheduling_policy_name(int policy) {
  for (const auto& [number, name] : kPolicies) {
    if (number == policy) {
      return name;
    }
  }
  return fmt::format("{}", policy);
}

std::optional<int> scheduling_policy(const std::string& name) {
  for (const auto& [number, known] : kPolicies) {
    if (name == known) {
      return number;
    }
  }
  return std::nullopt;
}

std::string cpu_list(const std::vector<int>& cpus) {
  std::string text;
  for (std::size_t i = 0; i < cpus.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < cpus.size() && cpus[last + 1] == cpus[last] + 1) {
      ++last;
    }
    text += fmt::format("{}{}", text.empty() ? "" : ",", cpus[i]);
    if (last > i) {
      text += fmt::format("-{}", cpus[last]);
    }
    i = last;
  }
  return text;
}

std::optional<std::vector<int>> parse_cpu_list(std::string_view text) {
  std::vector<int> cpus;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view range = text.substr(begin, end - begin);
    const std::size_t dash = std::min(range.find('-'), range.size());
    const std::optional<int> first = cpu_number(range.substr(0, dash));
    const std::optional<int> last = dash == range.size() ? first : cpu_number(range.substr(dash + 1));
    if (!first || !last || *first < 0 || *last < *first || *last >= CPU_SETSIZE) {
      return std::nullopt;
    }
    for (int cpu = *first; cpu <= *last; ++cpu) {
      cpus.push_back(cpu);
    }
    begin = end + 1;
  }
  std::sort(cpus.begin(), cpus.end());
  cpus.erase(std::unique(cpus.begin(), cpus.end()), cpus.end());
  return cpus;
}

std::vector<std::string> describe(const ResourceLimits& limits) {
  std::vector<std::string> lines;
  if (limits.niceness) {
    lines.push_back(fmt::format("nice {}", *limits.niceness));
  }
  if (limits.policy) {
    const std::string priority = limits.priority != 0 ? fmt::format(" {}", limits.priority) : "";
    lines.push_back(fmt::format("policy {}{}", scheduling_policy_name(*limits.policy), priority));
  }
  if (limits.policy == kDeadlinePolicy) {
    lines.push_back(schedule_text(limits.schedule));
  }
  if (limits.timer_slack) {
    lines.push_back(fmt::format("timer slack {} ns", limits.timer_slack->count()));
  }
  if (limits.oom_score_adj) {
    lines.push_back(fmt::format("oom_score_adj {}", *limits.oom_score_adj));
  }
  if (limits.locked_memory) {
    lines.push_back(fmt::format("{} of locked memory", bytes_text(*limits.locked_memory)));
  }
  if (!limits.cpus.empty()) {
    lines.push_back(fmt::format("cpus {}", cpu_list(limits.cpus)));
  }
  if (limits.memory) {
    lines.push_back(fmt::format("memory {} bytes", *limits.memory));
  }
  if (limits.open_files) {
    lines.push_back(fmt::format("{} open files", *limits.open_files));
  }
  if (limits.core_files) {
    lines.push_back("core files");
  }
  return lines;
}

std::vector<std::string> launch_exec_arguments(const ResourceLimits& limits) {
  std::vector<std::string> arguments;
  if (!limits.control_group.empty()) {
    arguments.push_back(kStepControlGroup + limits.control_group);
  }
  if (limits.oom_score_adj) {
    arguments.push_back(fmt::format("{}{}", kStepOomScore, *limits.oom_score_adj));
  }
  if (limits.locked_memory) {
    arguments.push_back(*limits.locked_memory == kUnlimited
                            ? fmt::format("{}unlimited", kStepLockedMemory)
                            : fmt::format("{}{}", kStepLockedMemory, *limits.locked_memory));
  }
  if (limits.timer_slack) {
    arguments.push_back(fmt::format("{}{}", kStepTimerSlack, limits.timer_slack->count()));
  }
  if (!limits.cpus.empty()) {
    arguments.push_back(fmt::format("{}{}", kStepCpus, fmt::join(limits.cpus, ",")));
  }
  if (limits.memory) {
    arguments.push_back(fmt::format("{}{}", kStepMemory, *limits.memory));
  }
  if (limits.open_files) {
    arguments.push_back(fmt::format("{}{}", kStepOpenFiles, *limits.open_files));
  }
  if (limits.core_files) {
    arguments.emplace_back(1, kStepCoreFiles);
  }
  if (limits.niceness) {
    arguments.push_back(fmt::format("{}{}", kStepNice, *limits.niceness));
  }
  if (limits.policy == kDeadlinePolicy) {
    arguments.push_back(fmt::format("{}{},{},{}", kStepDeadline, limits.schedule.runtime.count(),
                                    limits.schedule.deadline.count(), limits.schedule.period.count()));
  } else if (limits.policy) {
    arguments.push_back(fmt::format("{}{},{}", kStepPolicy, *limits.policy, limits.priority));
  }
  arguments.push_back(std::string(1, kStepExec));
  return arguments;
}

std::string limit_failure(char step, int error, const ResourceLimits& limits) {
  const bool refused = error == EPERM || error == EACCES;
  switch (step) {
    case kStepNice:
      return fmt::format("cannot set the niceness {}{}", *limits.niceness,
                         refused ? " (" + how_to_permit("nice", *limits.niceness) + ")" : "");
    case kStepPolicy:
      return fmt::format("cannot set the scheduling policy {} with priority {}{}",
                         scheduling_policy_name(*limits.policy), limits.priority,
                         refused ? " (" + how_to_permit("rtprio", limits.priority) + ")" : "");
    case kStepCpus:
      return fmt::format("cannot run on the CPUs {} (the launcher may use {})", cpu_list(limits.cpus),
                         cpu_list(allowed_cpus()));
    case kStepMemory:
      return fmt::format("cannot limit the memory to {} bytes (the hard limit is {})", *limits.memory,
                         hard_limit(RLIMIT_DATA));
    case kStepOpenFiles:
      return fmt::format(
          "cannot allow {} open files (the hard limit is {}; raise it with the line `YOUR_USER - nofile "
          "{}` in a file in /etc/security/limits.d)",
          *limits.open_files, hard_limit(RLIMIT_NOFILE), *limits.open_files);
    case kStepCoreFiles:
      return "cannot allow core files";
    case kStepDeadline:
      return fmt::format("cannot have {} ({})", schedule_text(limits.schedule),
                         error == EBUSY   ? "the processes with this policy together may not have more than "
                                            "/proc/sys/kernel/sched_rt_runtime_us of each sched_rt_period_us"
                         : error == EPERM ? "the launcher needs the capability CAP_SYS_NICE, and all CPUs of its cpuset"
                                          : "the kernel refuses it");
    case kStepTimerSlack:
      return "cannot set the timer slack";
    case kStepOomScore:
      return fmt::format("cannot set oom_score_adj to {}{}", *limits.oom_score_adj,
                         refused ? " (below that of the launcher it needs the capability CAP_SYS_RESOURCE)" : "");
    case kStepLockedMemory:
      return fmt::format(
          "cannot allow {} of locked memory (the hard limit is {}; raise it with the line `YOUR_USER - "
          "memlock unlimited` in a file in /etc/security/limits.d)",
          bytes_text(*limits.locked_memory), hard_limit(RLIMIT_MEMLOCK));
    case kStepControlGroup:
      return fmt::format("cannot enter the cgroup '{}'", limits.control_group);
    case kStepNamespaces:
      return "cannot enter the namespaces of the launch";
    default:
      return fmt::format("launch-exec failed at step '{}'", step);
  }
}

}  // namespace launch
