// SPDX-License-Identifier: Apache-2.0
// launch-exec: applies scheduling and limits to itself, enters namespaces, then becomes another program.
//
// A program may read its limits and make its threads before its first own instruction, so the limits have to be set
// before it starts. posix_spawn(3) has no attributes for most of them. This program is linked statically: nothing is
// preloaded into it, and it takes half a millisecond.
#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/exec/scheduling_attributes.hpp"

namespace {

using namespace launch;

[[noreturn]] void fail(char step, int error) {
  const LaunchExecFailure failure{step, error};
  // A failing write means that the launcher no longer reads, so nobody needs the report.
  static_cast<void>(!::write(kLaunchExecError, &failure, sizeof failure));
  ::_exit(127);
}

void check(char step, int result) {
  if (result != 0) {
    fail(step, errno);
  }
}

// Sets the soft limit and the hard limit.
int set_limit(int resource, rlim_t value) {
  rlimit limit{};
  ::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  limit.rlim_cur = value;
  limit.rlim_max = value;
  return ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

// The soft limit alone: as much as the process may have.
int allow_core_files() {
  rlimit limit{};
  ::getrlimit(RLIMIT_CORE, &limit);
  limit.rlim_cur = limit.rlim_max;
  return ::setrlimit(RLIMIT_CORE, &limit);
}

int set_cpus(const char* text) {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  for (char* end = nullptr; *text != '\0'; text = *end == ',' ? end + 1 : end) {
    CPU_SET(std::strtoul(text, &end, 10), &cpus);
  }
  return ::sched_setaffinity(0, sizeof cpus, &cpus);
}

int set_policy(const char* text) {
  char* end = nullptr;
  const int policy = static_cast<int>(std::strtol(text, &end, 10));
  sched_param parameters{};
  parameters.sched_priority = static_cast<int>(std::strtol(end + 1, nullptr, 10));
  return ::sched_setscheduler(0, policy, &parameters);
}

// A thread with this policy can't start others, unless they begin with the ordinary one.
int set_deadline(const char* text) {
  constexpr std::uint32_t kDeadline = 6;     // SCHED_DEADLINE
  constexpr std::uint64_t kResetOnFork = 1;  // SCHED_FLAG_RESET_ON_FORK
  SchedulingAttributes attributes{};
  attributes.policy = kDeadline;
  attributes.flags = kResetOnFork;
  char* end = nullptr;
  attributes.runtime = std::strtoull(text, &end, 10);
  attributes.deadline = std::strtoull(end + 1, &end, 10);
  attributes.period = std::strtoull(end + 1, &end, 10);
  return set_scheduling(0, attributes);
}

int write_file(const char* path, const char* text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  const auto size = static_cast<ssize_t>(std::strlen(text));
  const bool written = file >= 0 && ::write(file, text, static_cast<std::size_t>(size)) == size;
  const int error = errno;
  ::close(file);
  errno = error;
  return written ? 0 : -1;
}

int enter_control_group(const char* directory) {
  std::array<char, PATH_MAX> path{};
  constexpr const char* kProcesses = "/cgroup.procs";
  if (std::strlen(directory) + std::strlen(kProcesses) >= path.size()) {
    errno = ENAMETOOLONG;
    return -1;
  }
  ::stpcpy(::stpcpy(path.data(), directory), kProcesses);
  return write_file(path.data(), "0");
}

// The directory stays the same, by its path: a process that enters a mount namespace is in the root of it.
int enter_namespaces(int count) {
  std::array<char, PATH_MAX> directory{};
  const bool has_directory = ::getcwd(directory.data(), directory.size()) != nullptr;
  for (int file = kLaunchExecNamespaces; file < kLaunchExecNamespaces + count; ++file) {
    if (::setns(file, 0) != 0) {
      return -1;
    }
    ::close(file);
  }
  return has_directory ? ::chdir(directory.data()) : 0;
}

void apply(char step, const char* value) {
  switch (step) {
    case kStepNice:
      return check(step, ::setpriority(PRIO_PROCESS, 0, std::atoi(value)));
    case kStepPolicy:
      return check(step, set_policy(value));
    case kStepCpus:
      return check(step, set_cpus(value));
    case kStepMemory:
      return check(step, set_limit(RLIMIT_DATA, std::strtoull(value, nullptr, 10)));
    case kStepOpenFiles:
      return check(step, set_limit(RLIMIT_NOFILE, std::strtoull(value, nullptr, 10)));
    case kStepCoreFiles:
      return check(step, allow_core_files());
    case kStepDeadline:
      return check(step, set_deadline(value));
    case kStepTimerSlack:
      return check(step, ::prctl(PR_SET_TIMERSLACK, std::strtoul(value, nullptr, 10)));
    case kStepControlGroup:
      return check(step, enter_control_group(value));
    case kStepOomScore:
      return check(step, write_file("/proc/self/oom_score_adj", value));
    case kStepLockedMemory:
      return check(step,
                   set_limit(RLIMIT_MEMLOCK,
                             std::strcmp(value, "unlimited") == 0 ? RLIM_INFINITY : std::strtoull(value, nullptr, 10)));
    case kStepNamespaces:
      return check(step, enter_namespaces(std::atoi(value)));
    default:
      fail(step, EINVAL);
  }
}

}  // namespace

int main(int argc, char** argv, char** environment) {
  check(kStepExec, ::fcntl(kLaunchExecError, F_SETFD, FD_CLOEXEC));
  int next = 1;
  for (; next < argc && argv[next][0] != kStepExec; ++next) {
    apply(argv[next][0], argv[next] + 1);
  }
  if (next + 2 >= argc) {
    fail(kStepExec, EINVAL);
  }
  ::execve(argv[next + 1], argv + next + 2, environment);
  fail(kStepExec, errno);
}
