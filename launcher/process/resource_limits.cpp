// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/resource_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "launcher/process/exec/launch_exec_protocol.hpp"

namespace launch {

namespace {

constexpr std::array<std::pair<int, const char*>, 5> kPolicies{
    {{SCHED_OTHER, "other"}, {SCHED_BATCH, "batch"}, {SCHED_IDLE, "idle"}, {SCHED_FIFO, "fifo"}, {SCHED_RR, "rr"}}};

// Tells a user who is not root how to get a right that pam_limits gives.
std::string how_to_permit(const char* item, long value) {
  return fmt::format(
      "add the line `{} - {} {}` to a file in /etc/security/limits.d and log in again, or give the launcher "
      "the capability CAP_SYS_NICE",
      ::getuid() == 0 ? "root" : "YOUR_USER", item, value);
}

std::string hard_limit(__rlimit_resource_t resource) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  return limit.rlim_max == RLIM_INFINITY ? "unlimited" : fmt::format("{}", limit.rlim_max);
}

std::string allowed_cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  std::vector<int> cpus;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(static_cast<std::size_t>(cpu), &set)) {
      cpus.push_back(cpu);
    }
  }
  return cpu_list(cpus);
}

}  // namespace

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

std::vector<std::string> describe(const ResourceLimits& limits) {
  std::vector<std::string> lines;
  if (limits.niceness) {
    lines.push_back(fmt::format("nice {}", *limits.niceness));
  }
  if (limits.policy) {
    const std::string priority = limits.priority != 0 ? fmt::format(" {}", limits.priority) : "";
    lines.push_back(fmt::format("policy {}{}", scheduling_policy_name(*limits.policy), priority));
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
  if (limits.policy) {
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
      return fmt::format("cannot run on the CPUs {} (the launcher may use {})", cpu_list(limits.cpus), allowed_cpus());
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
    case kStepNamespaces:
      return "cannot enter the namespaces of the launch";
    default:
      return fmt::format("launch-exec failed at step '{}'", step);
  }
}

}  // namespace launch
