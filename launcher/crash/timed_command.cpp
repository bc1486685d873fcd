// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/timed_command.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

TimedCommand run_timed(const std::vector<std::string>& argv, const std::string& output, std::chrono::milliseconds limit,
                       const std::atomic<bool>* hurry) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kTurn(100);
  const UniqueFd file(output.empty() ? -1 : ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  const int to = file ? file.get() : kDevNull;
  TimedCommand result;
  pid_t pid = -1;
  try {
    pid = spawn({.program = argv.front(),
                 .argv = argv,
                 .search_path = true,
                 .descriptors = {{STDIN_FILENO, kDevNull}, {STDOUT_FILENO, to}, {STDERR_FILENO, to}},
                 .only_given_descriptors = true,
                 .group = ChildGroup::kOwn,
                 .signals = ChildSignals::kFresh});
  } catch (const SpawnError&) {
    return result;
  }
  result.started = true;
  const Clock::time_point deadline = Clock::now() + limit;
  while (!result.in_time && Clock::now() < deadline && !(hurry != nullptr && *hurry)) {
    result.in_time = ends_within(pid, kTurn);
  }
  if (!result.in_time) {
    ::kill(-pid, SIGKILL);
  }
  const int status = wait_for(pid);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

}  // namespace launch
