// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/group_scheduling.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "launcher/process/exec/launch_exec_protocol.hpp"

namespace launch {
namespace {

constexpr std::uint64_t kResetOnFork = 1;  // SCHED_FLAG_RESET_ON_FORK, which only some may clear

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

SchedulingParts parts_of(const ResourceLimits& wanted) {
  return {wanted.niceness.has_value(), wanted.policy.has_value(), !wanted.cpus.empty()};
}

bool has_parts(const SchedulingParts& parts) {
  return parts.niceness || parts.policy || parts.cpus;
}

// Changes these parts. The step at which the kernel has refused it, with errno; 0: none. What is refused most often
// comes before the niceness, which not everybody may lower again.
char apply(pid_t thread, const ThreadScheduling& now, const ThreadScheduling& wanted, const SchedulingParts& parts) {
  if (parts.cpus && ::sched_setaffinity(thread, sizeof wanted.cpus, &wanted.cpus) != 0) {
    return kStepCpus;
  }
  SchedulingAttributes attributes = wanted.attributes;
  attributes.nice = now.attributes.nice;
  if (parts.policy && set_scheduling(thread, attributes) != 0) {
    return kStepPolicy;
  }
  return parts.niceness && ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), wanted.attributes.nice) != 0
             ? kStepNice
             : '\0';
}

// Of the parts, those in which the thread has these values.
SchedulingParts parts_with(const ThreadScheduling& now, const ThreadScheduling& values, SchedulingParts parts) {
  parts.niceness = parts.niceness && now.attributes.nice == values.attributes.nice;
  parts.policy = parts.policy && now.attributes.policy == values.attributes.policy &&
                 now.attributes.priority == values.attributes.priority;
  parts.cpus = parts.cpus && CPU_EQUAL(&now.cpus, &values.cpus);
  return parts;
}

// Tries each part, whatever becomes of the others. 0, or an errno.
int put_back(pid_t thread, const ThreadScheduling& before, const SchedulingParts& parts) {
  const std::optional<ThreadScheduling> now = scheduling_of(thread);
  if (!now) {
    return 0;
  }
  int error = 0;
  const auto note = [&error](long result) {
    if (result != 0 && errno != ESRCH) {
      error = errno;
    }
  };
  if (parts.cpus) {
    note(::sched_setaffinity(thread, sizeof before.cpus, &before.cpus));
  }
  if (parts.policy) {
    SchedulingAttributes attributes = before.attributes;
    attributes.nice = parts.niceness ? before.attributes.nice : now->attributes.nice;
    note(set_scheduling(thread, attributes));
  }
  if (parts.niceness) {
    note(::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), before.attributes.nice));
  }
  return error;
}

ThreadScheduling with(ThreadScheduling scheduling, const ResourceLimits& wanted) {
  SchedulingAttributes& attributes = scheduling.attributes;
  if (wanted.niceness) {
    attributes.nice = *wanted.niceness;
  }
  if (wanted.policy) {
    attributes.policy = static_cast<std::uint32_t>(*wanted.policy);
    attributes.priority = static_cast<std::uint32_t>(wanted.priority);
    attributes.flags &= kResetOnFork;
  }
  if (!wanted.cpus.empty()) {
    CPU_ZERO(&scheduling.cpus);
    for (const int cpu : wanted.cpus) {
      CPU_SET(static_cast<std::size_t>(cpu), &scheduling.cpus);
    }
  }
  return scheduling;
}

// Calls `visit` with each thread once, until it returns false or there are no more. `is_later`: it was not there when
// the first of them was visited, and has what the thread had that has started it.
template <typename Visit>
void for_each_thread(const ProcessesOfGroup& processes, Visit visit) {
  std::set<pid_t> seen;
  bool is_later = false;
  for (bool found = true; found; is_later = true) {
    std::vector<pid_t> threads;
    for (const pid_t process : processes()) {
      for (const pid_t thread : threads_of(process)) {
        if (seen.insert(thread).second) {
          threads.push_back(thread);
        }
      }
    }
    found = !threads.empty();
    for (const pid_t thread : threads) {
      if (!visit(thread, is_later)) {
        return;
      }
    }
  }
}

void add(SchedulingParts& parts, const SchedulingParts& more) {
  parts.niceness = parts.niceness || more.niceness;
  parts.policy = parts.policy || more.policy;
  parts.cpus = parts.cpus || more.cpus;
}

}  // namespace

std::optional<SchedulingFailure> change_scheduling(const ProcessesOfGroup& processes, const ResourceLimits& wanted,
                                                   GroupScheduling& before) {
  const SchedulingParts parts = parts_of(wanted);
  std::map<pid_t, ThreadScheduling> changed;
  std::optional<SchedulingFailure> failure;
  for_each_thread(processes, [&](pid_t thread, bool is_later) {
    const std::optional<ThreadScheduling> now = scheduling_of(thread);
    if (!now) {
      return true;
    }
    const char step = apply(thread, *now, with(*now, wanted), parts);
    if (step != 0 && errno == ESRCH) {
      return true;
    }
    if (step != 0) {
      failure = SchedulingFailure{step, errno};
    }
    if (failure || !is_later) {
      changed.emplace(thread, *now);
    }
    return !failure;
  });
  if (failure) {
    std::erase_if(changed, [&](const auto& one) { return put_back(one.first, one.second, parts) == 0; });
    failure->leaves_changes = !changed.empty();
  }
  if (!before.has_all) {
    before.threads.merge(changed);
    before.has_all = !failure;
  }
  if (!failure || failure->leaves_changes) {
    add(before.changed, parts);
    before.last = with(before.last, wanted);
  }
  return failure;
}

std::optional<SchedulingFailure> restore_scheduling(const ProcessesOfGroup& processes, const GroupScheduling& before) {
  std::optional<SchedulingFailure> failure;
  const auto main_thread = before.threads.find(before.main_thread);
  for_each_thread(processes, [&](pid_t thread, bool) {
    auto known = before.threads.find(thread);
    if (known == before.threads.end()) {
      known = main_thread;
    }
    const std::optional<ThreadScheduling> now = scheduling_of(thread);
    if (known == before.threads.end() || !now) {
      return true;
    }
    const SchedulingParts parts = parts_with(*now, before.last, before.changed);
    if (const int error = has_parts(parts) ? put_back(thread, known->second, parts) : 0; error != 0) {
      failure = SchedulingFailure{0, error};
    }
    return true;
  });
  return failure;
}

std::string failure_text(const SchedulingFailure& failure, const ResourceLimits& wanted) {
  if (failure.error == ENOTSUP) {
    return "it runs on another machine, where this can't be done yet";
  }
  const std::string reason = ": " + std::generic_category().message(failure.error);
  if (failure.step == 0) {
    const char* const needs = failure.error == EPERM ? " (that needs the capability CAP_SYS_NICE)" : "";
    return fmt::format("not every thread gets back what it had{}{}", needs, reason);
  }
  return fmt::format("{}{}{}", limit_failure(failure.step, failure.error, wanted), reason,
                     failure.leaves_changes ? "; some threads stay changed, because giving back what they had needs "
                                              "the capability CAP_SYS_NICE"
                                            : "");
}

}  // namespace launch
