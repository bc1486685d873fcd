// SPDX-License-Identifier: Apache-2.0
// launch-exec: applies scheduling and limits to itself, enters namespaces, then becomes another program.
//
// A program may read its limits and make its threads before its first own instruction, so the limits have to be set
// before it starts. posix_spawn(3) has no attributes for most of them. This program is linked statically: nothing is
// preloaded into it, and it takes half a millisecond.
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>

#include "launcher/process/exec/launch_exec_protocol.hpp"

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
