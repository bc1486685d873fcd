// SPDX-License-Identifier: Apache-2.0
// launch-guardian: the process above the launcher (guardian.hpp, guardian_protocol.hpp).
//
// It is linked statically and stays small, because each launch has it twice: a spare, in a session of its own, ends
// everything when launcher and guardian are killed together.
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/files/unique_fd.hpp"
#include "base/terminal/terminal.hpp"
#include "programs/guardian/clean_ups.hpp"
#include "programs/guardian/gentle_end.hpp"
#include "programs/guardian/launch_cgroup.hpp"
#include "programs/guardian/unanswered_signals.hpp"

namespace {

using launch::UniqueFd;

constexpr int kExitCodeOfSignal = 128;  // plus its number, as shells count

UniqueFd open_process(pid_t pid) {
  return UniqueFd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

void wait_for_end(const UniqueFd& process) {
  pollfd ended{process.get(), POLLIN, 0};
  while (::poll(&ended, 1, -1) != 1) {
  }
}

class GuardianProcess {
 public:
  GuardianProcess(std::string id, pid_t launcher, int records, UniqueFd ready, std::set<pid_t> strangers);

  // Returns the wait status of the launcher after everything has ended.
  int run();
  // Waits for the end of the launcher, the parent of this process, and ends what it leaves.
  [[noreturn]] void follow_launcher();
  bool ended_all() const { return ended_all_; }

 private:
  void watch_signals();
  void start_spare();
  [[noreturn]] void be_spare();
  void pass_on(const signalfd_siginfo& signal) const;
  void end_blocked_launcher() const;
  bool reap();  // true when the launcher has ended
  void end_rest(launch::LaunchMembers members, const std::string& launcher_ended, int signals);
  std::string launcher_ended() const;

  const std::string id_;
  const pid_t launcher_;
  const int records_;
  const pid_t group_ = ::getpgrp();
  const pid_t session_ = ::getsid(0);
  UniqueFd ready_;
  std::set<pid_t> strangers_;
  UniqueFd launcher_process_ = open_process(launcher_);
  UniqueFd guardian_process_ = open_process(::getpid());
  UniqueFd signals_;
  const std::optional<launch::TerminalState> terminal_ = launch::TerminalState::of(STDIN_FILENO);
  launch::UnansweredSignals unanswered_{launcher_};
  launch::LaunchCgroup cgroup_;
  pid_t spare_ = -1;
  int status_ = 0;
  bool ended_all_ = true;
};

GuardianProcess::GuardianProcess(std::string id, pid_t launcher, int records, UniqueFd ready, std::set<pid_t> strangers)
    : id_(std::move(id)),
      launcher_(launcher),
      records_(records),
      ready_(std::move(ready)),
      strangers_(std::move(strangers)) {}

int GuardianProcess::run() {
  watch_signals();
  cgroup_ = launch::LaunchCgroup::make(id_, launcher_);  // before the launcher is told that this process is ready
  start_spare();
  for (bool ended = reap(); !ended;) {
    signalfd_siginfo signal{};
    if (::read(signals_.get(), &signal, sizeof signal) != sizeof signal) {
      pollfd readable{signals_.get(), POLLIN, 0};
      if (::poll(&readable, 1, unanswered_.next_look()) == 0 && unanswered_.over()) {
        end_blocked_launcher();
      }
    } else if (signal.ssi_signo == SIGCHLD) {
      ended = reap();
    } else {
      pass_on(signal);
      unanswered_.over();  // from now on it looks again and again, if the launcher has not taken the signal yet
    }
  }
  strangers_.insert(spare_);
  if (WIFSIGNALED(status_)) {
    launch::GuardianLog::erase_status_line();
  }
  end_rest({.launch_id = id_, .group = group_, .session = session_, .strangers = strangers_, .cgroup = cgroup_},
           launcher_ended(), signals_.get());
  if (WIFSIGNALED(status_) && terminal_) {
    terminal_->restore();  // a process that had it may have been killed
  }
  ::kill(spare_, SIGKILL);
  ::waitpid(spare_, nullptr, 0);
  return status_;
}

// All signals are blocked from the start on: the launcher has blocked them before it became this program.
void GuardianProcess::watch_signals() {
  sigset_t watched;
  sigfillset(&watched);
  // What these say is about this process alone.
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGSEGV, SIGSYS, SIGTRAP, SIGTTIN, SIGTTOU}) {
    sigdelset(&watched, signal);
  }
  // nohup(1) ignores SIGHUP, and the launcher shall not see it either. A blocked signal arrives even if it is ignored.
  struct sigaction action {};
  if (::sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) {
    sigdelset(&watched, SIGHUP);
  }
  signals_.reset(::signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK));
}

void GuardianProcess::follow_launcher() {
  guardian_process_.reset();  // there is none any more
  if (::getppid() != launcher_) {
    launcher_process_.reset();  // it has ended, and its number may be that of another process
  }
  be_spare();
}

void GuardianProcess::start_spare() {
  spare_ = ::fork();
  if (spare_ == 0) {
    be_spare();
  }
  ready_.reset();
}

// Ctrl-C and the end of the terminal do not reach the session of the spare.
void GuardianProcess::be_spare() {
  ::setsid();
  ::prctl(PR_SET_NAME, "guardian-spare");
  ready_.reset();
  // A launcher without a guardian gets SIGTERM from the kernel. It can be too busy to take it.
  launch::UnansweredSignals unanswered(launcher_);
  std::array<pollfd, 2> ended{{{launcher_process_.get(), POLLIN, 0}, {guardian_process_.get(), POLLIN, 0}}};
  for (bool guarded = static_cast<bool>(guardian_process_); launcher_process_ && (ended[0].revents & POLLIN) == 0;) {
    ::poll(ended.data(), ended.size(), unanswered.next_look());
    if ((ended[1].revents & POLLIN) != 0) {
      guarded = false;
      ended[1].fd = -1;  // poll() skips it
    }
    if (!guarded && (ended[0].revents & POLLIN) == 0 && unanswered.over()) {
      ::syscall(SYS_pidfd_send_signal, launcher_process_.get(), SIGKILL, nullptr, 0);
    }
  }
  if (guardian_process_) {
    // A guardian that somebody has stopped must go on now.
    ::syscall(SYS_pidfd_send_signal, guardian_process_.get(), SIGCONT, nullptr, 0);
    wait_for_end(guardian_process_);
  }
  end_rest(
      {.launch_id = id_, .group = group_, .session = session_, .by_mark = true, .records = records_, .cgroup = cgroup_},
      "launcher and guardian have gone", -1);
  ::_exit(EXIT_SUCCESS);
}

// What the terminal sends reaches the launcher without our help, because it is in our process group. But the end of the
// terminal reaches only the leader of the session, and that is this process in `xterm -e launch …`.
void GuardianProcess::pass_on(const signalfd_siginfo& signal) const {
  if (signal.ssi_code != SI_KERNEL || signal.ssi_signo == SIGHUP) {
    ::kill(launcher_, static_cast<int>(signal.ssi_signo));
  }
}

void GuardianProcess::end_blocked_launcher() const {
  launch::GuardianLog log;
  if (const std::string path = launch::read_records(records_).log; !path.empty()) {
    log.open(path);
  }
  log.say("ERROR", "the launcher has not answered a signal for " +
                       std::to_string(launch::UnansweredSignals::kPatience.count()) +
                       " s, so something in it is blocked; launch-guardian ends it");
  ::kill(launcher_, SIGKILL);
}

bool GuardianProcess::reap() {
  int status = 0;
  for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
    if (WIFSTOPPED(status)) {
      // Ctrl-Z: a shell waits for us, not for the launcher. What another process stops with SIGSTOP is not our matter.
      if (pid == launcher_ && WSTOPSIG(status) != SIGSTOP) {
        ::raise(SIGSTOP);
      }
    } else if (pid == launcher_) {
      status_ = status;
      return true;
    } else if (pid == spare_) {
      start_spare();
    }
  }
  return false;
}

std::string GuardianProcess::launcher_ended() const {
  if (!WIFSIGNALED(status_)) {
    return "";
  }
  const char* const name = ::sigabbrev_np(WTERMSIG(status_));
  return std::string("the launcher was ended by ") + (name == nullptr ? "a signal" : std::string("SIG") + name);
}

void GuardianProcess::end_rest(launch::LaunchMembers members, const std::string& launcher_ended, int signals) {
  const launch::LeftWork work = launch::read_records(records_);
  launch::GuardianLog log;
  if (!work.log.empty()) {
    log.open(work.log);
  }
  const std::optional<std::set<pid_t>> children = members.by_mark ? std::nullopt : launch::own_children();
  // The end of nearly all launches: the spare is the only child.
  if (!children || *children != members.strangers) {
    ended_all_ = launch::GentleEnd(std::move(members), log).run(launcher_ended, signals);
  }
  cgroup_.remove();
  for (auto command = work.clean_ups.rbegin(); command != work.clean_ups.rend(); ++command) {
    if (const std::string failure = launch::run_clean_up(command->second, signals); !failure.empty()) {
      log.say("ERROR", failure);
    }
  }
}

// Ends this process as the launcher has ended.
[[noreturn]] void end_with(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    ::prctl(PR_SET_DUMPABLE, 0);  // the core of the launcher is the one to look at
    ::signal(number, SIG_DFL);
    ::kill(::getpid(), number);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, number);
    ::sigprocmask(SIG_UNBLOCK, &one, nullptr);
    ::_exit(kExitCodeOfSignal + number);  // process 1 of a container can't end by a signal
  }
  ::_exit(WEXITSTATUS(status));
}

std::set<pid_t> numbers(const char* text) {
  std::set<pid_t> all;
  for (char* end = nullptr; *text != '\0'; text = *end == ',' ? end + 1 : end) {
    all.insert(static_cast<pid_t>(std::strtol(text, &end, 10)));
    if (end == text) {
      break;
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const bool follows = argc >= 7 && std::strcmp(argv[6], "--after") == 0;
  if (argc < 7 || (!follows && std::strcmp(argv[6], "--") != 0)) {
    std::fputs("launch-guardian is started by launch, not by hand\n", stderr);
    return EXIT_FAILURE;
  }
  GuardianProcess guardian(argv[1], std::atoi(argv[2]), std::atoi(argv[3]), UniqueFd(std::atoi(argv[4])),
                           numbers(argv[5]));
  if (follows) {
    guardian.follow_launcher();
  }
  const int status = guardian.run();
  if (!guardian.ended_all() && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
    return EXIT_FAILURE;
  }
  end_with(status);
}
