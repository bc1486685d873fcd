// SPDX-License-Identifier: Apache-2.0
// Makes sure that no process survives the launcher, whatever ends the launcher, even kill -9.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "launcher/base/unique_fd.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {

// Owns the helper process launch-guardian, which has a session of its own, so that Ctrl-C does not reach it. When this
// object or the whole launcher goes away, the groups that are attached get SIGTERM, and SIGKILL after the grace period.
// Then the clean-up commands run.
class Guardian {
 public:
  static constexpr Duration kGrace = std::chrono::seconds(5);

  // Starts the helper; throws std::system_error. Make it early: it keeps the standard error output of this moment.
  explicit Guardian(const std::string& program = default_program(), Duration grace = kGrace);
  ~Guardian();  // waits for the helper: at once when nothing is attached, else up to the grace period
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  // Each takes one system call. They have no effect when the helper itself was killed: the launch goes on without it.
  void attach(pid_t group);
  void detach(pid_t group);

  // Adds a command, with the path of its program, that runs when the launcher has gone and the attached groups have
  // ended. The number that it returns takes the command back. Commands run in the opposite order, each for ten seconds
  // at most.
  std::int32_t add_clean_up(const std::vector<std::string>& command);
  void remove_clean_up(std::int32_t number);

  // The process number of the helper.
  pid_t pid() const { return pid_; }

  // ../lib/launch/launch-guardian, relative to the directory of this program.
  static std::string default_program();

 private:
  UniqueFd socket_;
  pid_t pid_ = -1;
  std::int32_t clean_ups_ = 0;  // numbers given so far
};

// A runner whose processes are attached to a guardian from their start until they are reaped.
class GuardedProcessRunner final : public ProcessRunner {
 public:
  // Both must outlive this runner.
  GuardedProcessRunner(ProcessRunner& runner, Guardian& guardian) : runner_(runner), guardian_(guardian) {}

  Process spawn(const ProcessSpec& spec) override;
  void signal_group(const Process& process, int signal) override { runner_.signal_group(process, signal); }
  ProcessExit outcome(const Process& process) override { return runner_.outcome(process); }
  ProcessExit reap(const Process& process) override;

 private:
  ProcessRunner& runner_;
  Guardian& guardian_;
};

}  // namespace launch
