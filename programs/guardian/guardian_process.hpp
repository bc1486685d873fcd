// SPDX-License-Identifier: Apache-2.0
// The guardian: the process that the user has started, above all others of the launch.
#pragma once

#include <sys/signalfd.h>
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"
#include "base/terminal/terminal.hpp"
#include "programs/guardian/death_in_python.hpp"
#include "programs/guardian/launch_rest.hpp"
#include "programs/guardian/unanswered_signals.hpp"

namespace launch {

class GuardianProcess {
 public:
  // `ready` is closed when signals are watched.
  GuardianProcess(GuardedLaunch launch, UniqueFd ready);

  // Returns the wait status of the launcher after everything has ended.
  int run();
  bool ended_all() const { return ended_all_; }

 private:
  using Clock = std::chrono::steady_clock;

  void on_signal(const signalfd_siginfo& signal);
  void pass_on(const signalfd_siginfo& signal);
  void end_blocked_launcher() const;
  void reap();
  void note_end(pid_t pid, int status);
  // Whether the launcher has ended, as far as this process can know: a spare that somebody holds tells nothing.
  bool is_over();
  void tell(const DeathInPython& death) const;
  void finish();

  GuardedLaunch launch_;
  UniqueFd launcher_ = open_process(launch_.launcher);
  UniqueFd self_ = open_process(::getpid());
  UniqueFd signals_ = watch_signals();
  const std::optional<TerminalState> terminal_ = TerminalState::of(STDIN_FILENO);
  UnansweredSignals unanswered_{launch_.launcher};
  pid_t spare_ = launch_.other;                  // -1: it was killed, and the launcher has become our child
  pid_t beside_ = -1;                            // the spare that has taken its place
  std::optional<int> status_;                    // of the launcher, once it has ended
  std::optional<Clock::time_point> dead_since_;  // the launcher, while nobody has told how it has ended
  bool nothing_left_ = false;
  bool ended_all_ = true;
};

}  // namespace launch
