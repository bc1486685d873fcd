// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/contained_launch.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/terminal/terminal.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"
#include "launcher/process/guardian/process_scan.hpp"
#include "programs/guardian/guardian_log.hpp"
#include "programs/guardian/launch_rest.hpp"

namespace launch {
namespace {

// What the terminal sends reaches all of the process group. But the end of the terminal reaches only the leader of the
// session.
bool is_to_be_passed_on(const signalfd_siginfo& signal) {
  return signal.ssi_signo != SIGCHLD && (signal.ssi_code != SI_KERNEL || signal.ssi_signo == SIGHUP);
}

void open_log(GuardianLog& log, const LeftWork& work) {
  if (!work.log.empty()) {
    log.open(work.log);
  }
}

class OutsideProcess {
 public:
  OutsideProcess(pid_t first, int records, UniqueFd inside)
      : first_(first), records_(records), inside_(std::move(inside)) {}

  [[noreturn]] void run() {
    while (first_ > 0) {
      std::array<pollfd, 2> wait{{{signals_.get(), POLLIN, 0}, {inside_.get(), POLLIN, 0}}};
      ::poll(wait.data(), wait.size(), -1);
      read_news();
      for (signalfd_siginfo signal{}; ::read(signals_.get(), &signal, sizeof signal) == sizeof signal;) {
        if (is_to_be_passed_on(signal)) {
          ::kill(first_, static_cast<int>(signal.ssi_signo));
        }
      }
      reap();
    }
    read_news();
    if (status_) {
      end_with(*status_);
    }
    clean_up();
    ::_exit(EXIT_FAILURE);
  }

 private:
  void read_news() {
    while (inside_) {
      ContainedNews news{};
      const ssize_t size = ::recv(inside_.get(), &news, sizeof news, MSG_DONTWAIT);
      if (size == 0) {
        inside_.reset();
      } else if (size != sizeof news) {
        return;
      } else if (news.kind == ContainedNews::Kind::kEnded) {
        status_ = news.status;
      } else {
        ::raise(SIGSTOP);  // a shell waits for us
      }
    }
  }

  void reap() {
    int status = 0;
    for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
      if (pid == first_ && WIFSTOPPED(status)) {
        ::kill(pid, SIGCONT);  // it is needed, and nobody has a reason to stop it
      } else if (pid == first_) {
        first_ = -1;
      }
    }
  }

  void clean_up() {
    GuardianLog::erase_status_line();
    const LeftWork work = read_records(records_);
    GuardianLog log;
    open_log(log, work);
    log.say("ERROR",
            "the first process of the launch's namespace was killed, and the kernel has ended all others in it");
    run_clean_ups(records_, work, log, signals_.get());
    if (terminal_) {
      terminal_->restore();  // a process that had it may have been killed
    }
  }

  pid_t first_;  // -1: it has ended
  int records_;
  UniqueFd inside_;
  UniqueFd signals_ = watch_signals();
  const std::optional<TerminalState> terminal_ = TerminalState::of(STDIN_FILENO);
  std::optional<int> status_;  // of the guardian
};

class FirstProcess {
 public:
  FirstProcess(pid_t guardian, int records, UniqueFd outside, UniqueFd alive)
      : guardian_(guardian), records_(records), outside_(std::move(outside)), alive_(std::move(alive)) {}

  [[noreturn]] void run() {
    ::prctl(PR_SET_NAME, "guardian-first");
    while (alive_) {
      std::array<pollfd, 3> wait{{{signals_.get(), POLLIN, 0}, {outside_.get(), POLLIN, 0}, {alive_.get(), 0, 0}}};
      ::poll(wait.data(), wait.size(), -1);
      for (signalfd_siginfo signal{}; ::read(signals_.get(), &signal, sizeof signal) == sizeof signal;) {
        if (is_to_be_passed_on(signal)) {
          to_guardian(static_cast<int>(signal.ssi_signo));
        }
      }
      reap();
      if (wait[1].revents != 0) {  // nobody writes there
        outside_.reset();
        to_guardian(SIGTERM);
        to_guardian(SIGCONT);
      }
      if (wait[2].revents != 0) {
        alive_.reset();
      }
    }
    while (guardian_ > 0) {  // it has closed its files, so it is about to end
      pollfd signals{signals_.get(), POLLIN, 0};
      ::poll(&signals, 1, -1);
      for (signalfd_siginfo signal{}; ::read(signals_.get(), &signal, sizeof signal) == sizeof signal;) {
      }
      reap();
    }
    end_rest();
    tell(ContainedNews::Kind::kEnded);
    ::_exit(EXIT_SUCCESS);
  }

 private:
  void to_guardian(int signal) const {
    if (guardian_ > 0) {
      ::kill(guardian_, signal);
    }
  }

  void tell(ContainedNews::Kind kind) const {
    const ContainedNews news{kind, status_};
    if (outside_) {
      static_cast<void>(!::send(outside_.get(), &news, sizeof news, MSG_NOSIGNAL));
    }
  }

  void reap() {
    int status = 0;
    for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
      if (pid == guardian_ && WIFSTOPPED(status)) {
        if (is_launcher_stopped()) {
          tell(ContainedNews::Kind::kStopped);
        }
      } else if (pid == guardian_) {
        guardian_ = -1;
        status_ = status;
      }
    }
  }

  // With Ctrl-Z it is, before the guardian. A guardian that somebody has stopped alone is continued by its spare.
  bool is_launcher_stopped() const {
    for (const pid_t spare : children_of(guardian_).value_or(std::set<pid_t>())) {
      for (const pid_t launcher : children_of(spare).value_or(std::set<pid_t>())) {
        const std::optional<FoundProcess> process = read_process(launcher);
        if (process && process->is_stopped()) {
          return true;
        }
      }
    }
    return false;
  }

  // The daemons of LTTng are those of the launch. The command that ends a trace needs them.
  static std::vector<FoundProcess> left_processes() {
    std::vector<FoundProcess> left = all_processes();
    std::erase_if(left, [](const FoundProcess& process) {
      return process.pid == ::getpid() || process.is_dead() || process.dying || process.name.starts_with("lttng-");
    });
    return left;
  }

  void end_rest() const {
    const LeftWork work = read_records(records_);
    GuardianLog log;
    open_log(log, work);
    if (const std::vector<FoundProcess> left = left_processes(); !left.empty()) {
      std::string names;
      for (const FoundProcess& process : left) {
        names += (names.empty() ? "" : ", ") + process.name + " (" + std::to_string(process.pid) + ")";
      }
      log.say("WARNING", "launcher and guardians have gone; the end of their namespace ends what is left: " + names);
    }
    if (!work.clean_ups.empty()) {
      for (const FoundProcess& process : left_processes()) {
        ::kill(process.pid, SIGKILL);
      }
      run_clean_ups(records_, work, log, signals_.get());
    }
    ::kill(-1, SIGKILL);
    while (::waitpid(-1, nullptr, 0) > 0) {
    }
  }

  pid_t guardian_;  // -1: it has ended
  int records_;
  UniqueFd outside_;
  UniqueFd alive_;
  UniqueFd signals_ = watch_signals();
  int status_ = EXIT_FAILURE << 8;  // of the guardian
};

}  // namespace

void stand_outside(pid_t first, int records, UniqueFd inside) {
  OutsideProcess(first, records, std::move(inside)).run();
}

void be_first(pid_t guardian, int records, UniqueFd outside, UniqueFd alive) {
  FirstProcess(guardian, records, std::move(outside), std::move(alive)).run();
}

}  // namespace launch
