// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/guardian_process.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"
#include "programs/guardian/clean_ups.hpp"
#include "programs/guardian/guardian_log.hpp"
#include "programs/guardian/spare_process.hpp"

namespace launch {
namespace {

// A spare tells of the end of the launcher within microseconds, unless somebody has stopped or traced it.
constexpr std::chrono::seconds kSilence{1};
constexpr int kBetweenLooksAtSilence = 100;  // milliseconds

}  // namespace

GuardianProcess::GuardianProcess(GuardedLaunch launch, UniqueFd ready) : launch_(std::move(launch)) {
  ready.reset();
}

int GuardianProcess::run() {
  reap();
  while (!is_over()) {
    signalfd_siginfo signal{};
    if (::read(signals_.get(), &signal, sizeof signal) == sizeof signal) {
      on_signal(signal);
      continue;
    }
    std::array<pollfd, 2> wait{{{signals_.get(), POLLIN, 0}, {dead_since_ ? -1 : launcher_.get(), POLLIN, 0}}};
    const int none = ::poll(wait.data(), wait.size(), dead_since_ ? kBetweenLooksAtSilence : unanswered_.next_look());
    if (none == 0 && !dead_since_ && unanswered_.over()) {
      end_blocked_launcher();
    }
  }
  finish();
  return *status_;
}

bool GuardianProcess::is_over() {
  if (!status_ && has_ended(launcher_)) {
    dead_since_ = dead_since_.value_or(Clock::now());
  }
  return status_ || (dead_since_ && Clock::now() - *dead_since_ > kSilence);
}

void GuardianProcess::on_signal(const signalfd_siginfo& signal) {
  const int what = static_cast<int>(signal.ssi_signo) - SIGRTMIN;
  const bool from_spare = spare_ > 0 && signal.ssi_code == SI_QUEUE && static_cast<pid_t>(signal.ssi_pid) == spare_;
  if (signal.ssi_signo == SIGCHLD) {
    reap();
  } else if (from_spare && what == kLauncherStopped) {
    ::raise(SIGSTOP);  // Ctrl-Z: a shell waits for us, not for the launcher
  } else if (from_spare && (what == kLauncherLeaves || what == kNothingLeft)) {
    status_ = signal.ssi_int;
    nothing_left_ = what == kNothingLeft;
  } else {
    pass_on(signal);
  }
}

// What the terminal sends reaches the launcher without our help, because it is in our process group. But the end of the
// terminal reaches only the leader of the session, and that is this process in `xterm -e launch …`.
void GuardianProcess::pass_on(const signalfd_siginfo& signal) {
  const int number = static_cast<int>(signal.ssi_signo);
  if (signal.ssi_code != SI_KERNEL || number == SIGHUP) {
    send_signal(launcher_, number);
  }
  if (number == SIGABRT) {
    send_signal(launcher_, SIGCONT);  // a service manager ends a launcher so that hangs, or that somebody has stopped
  }
  if (asks_to_end(number)) {
    // One that somebody has stopped would not see it. With Ctrl-Z this process is stopped, too, and comes here when it
    // goes on.
    send_signal(launcher_, SIGCONT);
    unanswered_.count();
  }
  if (unanswered_.over()) {  // from now on it looks again and again, if the launcher has not taken the signal yet
    end_blocked_launcher();
  }
}

void GuardianProcess::end_blocked_launcher() const {
  GuardianLog log;
  if (const std::string path = read_records(launch_.records).log; !path.empty()) {
    log.open(path);
  }
  log.say("ERROR", unanswered_.reason() + "; launch-guardian ends it");
  send_signal(launcher_, SIGKILL);
}

void GuardianProcess::reap() {
  int status = 0;
  for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
    if (!WIFSTOPPED(status)) {
      note_end(pid, status);
    } else if (pid == spare_ || pid == beside_) {
      ::kill(pid, SIGCONT);  // it is needed, and nobody has a reason to stop it
    } else if (pid == launch_.launcher && WSTOPSIG(status) != SIGSTOP) {
      ::raise(SIGSTOP);
    }
  }
}

void GuardianProcess::note_end(pid_t pid, int status) {
  if (pid == launch_.launcher) {
    status_ = status;
  } else if (pid == spare_ || pid == beside_) {
    spare_ = pid == spare_ ? -1 : spare_;  // its children have become ours, the launcher too
    beside_ = start_beside(launch_, self_);
  }
}

void GuardianProcess::tell(const DeathInPython& death) const {
  GuardianLog log;
  if (const std::string path = read_records(launch_.records).log; !path.empty()) {
    log.open(path);
  }
  log.error(death.error);
}

void GuardianProcess::finish() {
  std::string ended = status_ ? launcher_ended(*status_) : "the launcher has ended";
  const std::optional<DeathInPython> death = status_ ? death_in_python(launch_.records, *status_) : std::nullopt;
  if (!status_ || WIFSIGNALED(*status_) || death) {
    GuardianLog::erase_status_line();
  }
  if (death) {
    tell(*death);
    ended = "Python has ended the launcher";
  }
  LaunchMembers members = members_below(launch_);
  members.spare = spare_;
  members.reaped = [this](pid_t pid, int status) {
    const bool was_spare = pid == spare_ || pid == beside_;
    note_end(pid, status);
    return was_spare ? beside_ : -1;
  };
  members.launcher_ended = [this](int status) { status_ = status; };
  for (const pid_t spare : {spare_, beside_}) {
    if (spare > 0) {
      members.strangers.insert(spare);
    }
  }
  // Without a spare above the launcher, what it leaves has become ours.
  const bool nothing_left = nothing_left_ || (spare_ < 0 && children_of(::getpid()) == members.strangers);
  ended_all_ = end_rest(launch_, std::move(members), nothing_left, ended, signals_.get());
  if ((!status_ || WIFSIGNALED(*status_)) && terminal_) {
    terminal_->restore();  // a process that had it may have been killed
  }
  for (const pid_t spare : {spare_, beside_}) {
    if (spare > 0) {
      ::kill(spare, SIGKILL);
      ::waitpid(spare, nullptr, 0);
    }
  }
  reap();  // the launcher, if the spare has never told of its end
  status_ = status_.value_or(EXIT_FAILURE << 8);
  if (death && (death->by_launcher || *status_ == 0)) {
    status_ = EXIT_FAILURE << 8;
  }
}

}  // namespace launch
