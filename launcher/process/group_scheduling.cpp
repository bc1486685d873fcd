// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/group_scheduling.hpp"

#include <sys/resource.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "launcher/process/exec/launch_exec_protocol.hpp"

namespace launch {
namespace {

std::vector<pid_t> threads_of(pid_t process) {
  std::vector<pid_t> threads;
  std::error_code error;
  const std::filesystem::path folder = "/proc/" + std::to_string(process) + "/task";
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    pid_t thread = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), thread).ec == std::errc()) {
      threads.push_back(thread);
    }
  }
  return threads;
}

// Nullopt: it has ended.
std::optional<ThreadScheduling> scheduling_of(pid_t thread) {
  ThreadScheduling now;
  if (get_scheduling(thread, now.attributes) != 0 || ::sched_getaffinity(thread, sizeof now.cpus, &now.cpus) != 0) {
    return std::nullopt;
  }
  errno = 0;
  now.attributes.nice = ::getpriority(PRIO_PROCESS, static_cast<id_t>(thread));  // also with a real-time policy
  return now;
}

// The step at which the kernel has refused it, with errno; 0: none. Only those of `wanted`.
char apply(pid_t thread, const ThreadScheduling& wanted, const ResourceLimits& which) {
  if (!which.cpus.empty() && ::sched_setaffinity(thread, sizeof wanted.cpus, &wanted.cpus) != 0) {
    return kStepCpus;
  }
  if (which.niceness && ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), wanted.attributes.nice) != 0) {
    return kStepNice;
  }
  return which.policy && set_scheduling(thread, wanted.attributes) != 0 ? kStepPolicy : '\0';
}

bool put_back(pid_t thread, const ThreadScheduling& before) {
  const bool has_policy = set_scheduling(thread, before.attributes) == 0 || errno == ESRCH;
  const bool has_niceness =
      ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), before.attributes.nice) == 0 || errno == ESRCH;
  const bool has_cpus = ::sched_setaffinity(thread, sizeof before.cpus, &before.cpus) == 0 || errno == ESRCH;
  return has_policy && has_niceness && has_cpus;
}

ThreadScheduling with(ThreadScheduling scheduling, const ResourceLimits& wanted) {
  SchedulingAttributes& attributes = scheduling.attributes;
  if (wanted.niceness) {
    attributes.nice = *wanted.niceness;
  }
  if (wanted.policy) {
    attributes.policy = static_cast<std::uint32_t>(*wanted.policy);
    attributes.priority = static_cast<std::uint32_t>(wanted.priority);
    attributes.flags = 0;
  }
  if (!wanted.cpus.empty()) {
    CPU_ZERO(&scheduling.cpus);
    for (const int cpu : wanted.cpus) {
      CPU_SET(static_cast<std::size_t>(cpu), &scheduling.cpus);
    }
  }
  return scheduling;
}

// Calls `visit` with each thread once, until it returns false or there are no more.
template <typename Visit>
void for_each_thread(const ProcessesOfGroup& processes, Visit visit) {
  std::map<pid_t, bool> seen;
  for (bool found = true; found;) {
    found = false;
    for (const pid_t process : processes()) {
      for (const pid_t thread : threads_of(process)) {
        if (!seen.emplace(thread, true).second) {
          continue;
        }
        found = true;
        if (!visit(thread)) {
          return;
        }
      }
    }
  }
}

}  // namespace

std::optional<SchedulingFailure> change_scheduling(const ProcessesOfGroup& processes, const ResourceLimits& wanted,
                                                   GroupScheduling& before) {
  std::map<pid_t, ThreadScheduling> changed;
  std::optional<SchedulingFailure> failure;
  for_each_thread(processes, [&](pid_t thread) {
    const std::optional<ThreadScheduling> now = scheduling_of(thread);
    if (!now) {
      return true;
    }
    if (const char step = apply(thread, with(*now, wanted), wanted); step != 0 && errno != ESRCH) {
      failure = SchedulingFailure{step, errno};
      put_back(thread, *now);
      return false;
    }
    changed.emplace(thread, *now);
    return true;
  });
  if (!failure && before.threads.empty()) {
    before.threads = std::move(changed);
    return failure;
  }
  for (const auto& [thread, scheduling] : changed) {
    if (failure) {
      put_back(thread, scheduling);
    }
  }
  return failure;
}

std::optional<SchedulingFailure> restore_scheduling(const ProcessesOfGroup& processes, const GroupScheduling& before) {
  std::optional<SchedulingFailure> failure;
  const auto main_thread = before.threads.find(before.main_thread);
  for_each_thread(processes, [&](pid_t thread) {
    auto known = before.threads.find(thread);
    if (known == before.threads.end()) {
      known = main_thread;
    }
    if (known != before.threads.end() && !put_back(thread, known->second)) {
      failure = SchedulingFailure{0, errno};
    }
    return true;
  });
  return failure;
}

std::string failure_text(const SchedulingFailure& failure, const ResourceLimits& wanted) {
  if (failure.error == ENOTSUP) {
    return "it runs on another machine, where this can't be done yet";
  }
  const std::string what = failure.step == 0
                               ? "not every thread gets back what it had (that needs the capability CAP_SYS_NICE)"
                               : limit_failure(failure.step, failure.error, wanted);
  return what + ": " + std::generic_category().message(failure.error);
}

}  // namespace launch
