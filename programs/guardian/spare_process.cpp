// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/spare_process.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "launcher/process/guardian/guardian_protocol.hpp"
#include "programs/guardian/clean_ups.hpp"
#include "programs/guardian/launch_cgroup.hpp"
#include "programs/guardian/unanswered_signals.hpp"

namespace launch {
namespace {

// Nothing tells that somebody has stopped the guardian, which has the process number that the user knows.
constexpr int kBetweenLooksAtGuardian = 1000;  // milliseconds

// The spare between stays in the session of the launch: a process that is stopped when its parent dies would get SIGHUP
// from the kernel if its new parent were in another one. And a spare that is stopped itself is continued by the kernel
// when the guardian and the launcher die.
void leave_group() {
  ::setpgid(0, 0);
  ::prctl(PR_SET_NAME, "guardian-spare");
}

void leave_session() {
  ::setsid();
  ::prctl(PR_SET_NAME, "guardian-spare");
}

// One that another process has stopped can't make the signal itself.
void ask_to_end(const UniqueFd& launcher) {
  send_signal(launcher, SIGTERM);
  send_signal(launcher, SIGCONT);
}

// One that is stopped would not see that its launch has gone, and nobody there would end what it has started.
bool is_agent(pid_t launcher) {
  const std::optional<FoundProcess> process = read_process(launcher);
  return process && process->name == "launch-agent";
}

bool is_stopped(pid_t pid) {
  const std::optional<FoundProcess> process = read_process(pid);
  return process && process->state == 'T';
}

class SpareBetween {
 public:
  explicit SpareBetween(GuardedLaunch launch) : launch_(std::move(launch)) {}

  [[noreturn]] void run(UniqueFd ready);

 private:
  void reap();
  void note_end(pid_t pid, int status);
  void tell_guardian(int what, int value) const;
  void continue_guardian() const;
  void on_lost_guardian();
  [[noreturn]] void end_all();

  GuardedLaunch launch_;
  UniqueFd guardian_ = open_process(::getppid() == launch_.other ? launch_.other : -1);
  UniqueFd launcher_ = open_process(launch_.launcher);
  UniqueFd self_ = open_process(::getpid());
  pid_t beside_ = -1;  // the spare of this one, once the guardian has gone
  UniqueFd signals_ = watch_signals();
  LaunchCgroup cgroup_;
  std::optional<int> status_;  // of the launcher, once it has ended
  bool has_told_ = false;      // that nothing is left
  UnansweredSignals unanswered_{launch_.launcher};
};

void SpareBetween::run(UniqueFd ready) {
  cgroup_ = LaunchCgroup::make(launch_.id, launch_.launcher);
  ready.reset();
  for (bool guarded = true;; reap()) {
    if (guarded && has_ended(guardian_)) {
      guarded = false;
      guardian_.reset();
      on_lost_guardian();
    }
    if (guarded) {
      continue_guardian();
    } else if (has_ended(launcher_)) {
      end_all();
    } else if (unanswered_.over()) {
      send_signal(launcher_, SIGKILL);
    }
    // The end of a launcher that is traced makes no signal. poll(2) skips a negative descriptor.
    std::array<pollfd, 2> wait{{{signals_.get(), POLLIN, 0}, {guarded ? guardian_.get() : launcher_.get(), POLLIN, 0}}};
    ::poll(wait.data(), wait.size(), guarded ? kBetweenLooksAtGuardian : unanswered_.next_look());
    // Signals to this process mean nothing while the guardian lives; GentleEnd reads them later on.
    for (signalfd_siginfo signal{}; ::read(signals_.get(), &signal, sizeof signal) == sizeof signal;) {
    }
  }
}

void SpareBetween::reap() {
  int status = 0;
  pid_t pid = 0;
  bool launcher_ended = false;
  while ((pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0) {
    if (!WIFSTOPPED(status)) {
      launcher_ended = launcher_ended || pid == launch_.launcher;
      note_end(pid, status);
    } else if (pid == beside_) {
      ::kill(pid, SIGCONT);
    } else if (pid == launch_.launcher && WSTOPSIG(status) != SIGSTOP) {
      tell_guardian(kLauncherStopped, 0);
    } else if (pid == launch_.launcher && is_agent(pid)) {
      ::kill(pid, SIGCONT);
    }
  }
  if (status_ && pid < 0 && !has_told_) {
    has_told_ = true;
    cgroup_.remove();
    tell_guardian(kNothingLeft, *status_);
  } else if (launcher_ended) {
    tell_guardian(kLauncherLeaves, *status_);
  }
}

void SpareBetween::note_end(pid_t pid, int status) {
  if (pid == launch_.launcher) {
    status_ = status;
  } else if (pid == beside_) {
    beside_ = start_beside(launch_, self_);
  }
}

void SpareBetween::tell_guardian(int what, int value) const {
  if (guardian_) {
    ::sigqueue(launch_.other, SIGRTMIN + what, {.sival_int = value});
  }
}

// Ctrl-Z stops the launcher and then the guardian. A guardian that is stopped alone was stopped by somebody else.
void SpareBetween::continue_guardian() const {
  if (is_stopped(launch_.other) && (has_ended(launcher_) || !is_stopped(launch_.launcher))) {
    send_signal(guardian_, SIGCONT);
  }
}

// A launcher that was killed while another process traces it can be waited for only when that process has ended.
void SpareBetween::end_all() {
  LaunchMembers members = members_below(launch_);
  members.reaped = [this](pid_t pid, int status) {
    const bool was_spare = pid == beside_;
    note_end(pid, status);
    return was_spare ? beside_ : -1;
  };
  if (beside_ > 0) {
    members.strangers.insert(beside_);
  }
  const bool nothing_left = children_of(::getpid()) == members.strangers;
  const bool ended_all =
      end_rest(launch_, std::move(members), nothing_left, "launcher and guardian have gone", signals_.get());
  if (beside_ > 0) {
    ::kill(beside_, SIGKILL);
    ::waitpid(beside_, nullptr, 0);
  }
  const int status = status_.value_or(EXIT_FAILURE << 8);
  end_with(ended_all || status != 0 ? status : EXIT_FAILURE << 8);
}

// The launcher sees that the guardian has gone, and says so. It can be too busy to take the signal.
void SpareBetween::on_lost_guardian() {
  beside_ = start_beside(launch_, self_);
  if (!status_) {
    ask_to_end(launcher_);
    unanswered_.over();
  }
}

}  // namespace

void stand_between(GuardedLaunch launch, UniqueFd ready) {
  leave_group();
  SpareBetween(std::move(launch)).run(std::move(ready));
}

void stand_beside(const GuardedLaunch& launch, const UniqueFd& guardian) {
  leave_session();
  const UniqueFd launcher = open_process(launch.launcher);
  // A launcher without a guardian gets SIGTERM. It can be too busy to take it.
  UnansweredSignals unanswered(launch.launcher, read_inherited_mark(launch.records));
  bool guarded = static_cast<bool>(guardian);
  while (!has_ended(launcher)) {
    std::array<pollfd, 2> ended{{{launcher.get(), POLLIN, 0}, {guarded ? guardian.get() : -1, POLLIN, 0}}};
    ::poll(ended.data(), ended.size(), unanswered.next_look());
    if (guarded && has_ended(guardian)) {
      guarded = false;
      ask_to_end(launcher);
    }
    if (!guarded && unanswered.over()) {
      send_signal(launcher, SIGKILL);
    }
  }
  if (guardian) {
    send_signal(guardian, SIGCONT);  // a guardian that somebody has stopped must go on now
    pollfd ended{guardian.get(), POLLIN, 0};
    while (::poll(&ended, 1, -1) != 1) {
    }
  }
  LaunchMembers members = members_below(launch);
  members.by_mark = true;
  end_rest(launch, std::move(members), false, "launcher and guardian have gone", -1);
  ::_exit(EXIT_SUCCESS);
}

pid_t start_beside(const GuardedLaunch& launch, const UniqueFd& self) {
  const pid_t spare = ::fork();
  if (spare == 0) {
    stand_beside(launch, self);
  }
  return spare;
}

}  // namespace launch
