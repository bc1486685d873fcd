// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/user_signals.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <chrono>
#include <utility>
#include <vector>

#include "base/processes/ending_signals.hpp"
#include "base/processes/process_stat.hpp"

namespace launch {

namespace {

constexpr Duration kSameWish = std::chrono::seconds(1);

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// Whether nobody is there who could continue the group: who has started its first process is of another session. The
// kernel does not let Ctrl-Z stop such a group, but the guardians beside the launcher hide it from the kernel.
bool is_in_orphaned_group() {
  const pid_t first = ::getpgrp();
  if (first == 0) {
    return false;  // it is outside of the namespace of processes that the launch has for itself
  }
  const pid_t parent = read_process_stat(first).parent;
  return parent > 0 ? ::getsid(parent) != ::getsid(0) : first == ::getsid(0);
}

// As Ctrl-Z stops a program that does not handle SIGTSTP. Returns after SIGCONT.
void stop_this_process() {
  struct sigaction action {};
  struct sigaction before {};
  action.sa_handler = SIG_DFL;
  ::sigaction(SIGTSTP, &action, &before);
  sigset_t stop;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTSTP);
  ::raise(SIGTSTP);
  ::pthread_sigmask(SIG_UNBLOCK, &stop, nullptr);
  ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
  ::sigaction(SIGTSTP, &before, nullptr);
}

}  // namespace

UserSignals::UserSignals(EventLoop& loop, ProcessSupervisor& supervisor, Acts acts)
    : loop_(loop), supervisor_(supervisor), acts_(std::move(acts)) {}

void UserSignals::listen() {
  std::vector<int> ending;
  for (const int signal : kEndingSignals) {
    if (signal != SIGHUP || (!is_ignored(SIGHUP) && !on_hangup_)) {
      ending.push_back(signal);
    }
  }
  if (on_hangup_ && !is_ignored(SIGHUP)) {
    hangup_ = loop_.on_signal({SIGHUP}, [this](EventLoop::Signal) {
      if (!acts_.intercept()) {
        on_hangup_();
      }
    });
  }
  ending_ = loop_.on_signal(ending, [this](EventLoop::Signal signal) { on_signal(signal); });
  if (!is_ignored(SIGTSTP)) {
    stopping_ = loop_.on_signal({SIGTSTP}, [this](EventLoop::Signal) { suspend(); });
  }
  // When a process reads the terminal from the background, its whole group is asked to stop. The launcher goes on.
  ::signal(SIGTTIN, SIG_IGN);
  ::signal(SIGTTOU, SIG_IGN);
}

bool UserSignals::count_as_first() {
  if (counted_) {
    return false;
  }
  counted_ = loop_.now();
  return true;
}

void UserSignals::on_signal(EventLoop::Signal signal) {
  if (acts_.intercept()) {
    return;
  }
  if (signal.by_terminal) {
    supervisor_.note_signal_of_terminal();
  }
  if (counted_ && loop_.now() - *counted_ < kSameWish) {
    return;
  }
  const std::string name =
      signal.number == SIGINT ? "ctrl-c (SIGINT)" : fmt::format("SIG{}", sigabbrev_np(signal.number));
  if (std::exchange(counted_, loop_.now())) {
    acts_.again(signal.number, name);
  } else {
    acts_.first(name);
  }
}

void UserSignals::suspend() {
  if (is_in_orphaned_group()) {
    return;
  }
  if (on_suspension_) {
    on_suspension_(true);
  }
  acts_.tell("stopping the system, SIGCONT continues it");
  supervisor_.suspend();
  stop_this_process();
  supervisor_.resume();
  acts_.tell("continuing the system");
  if (on_suspension_) {
    on_suspension_(false);
  }
}

}  // namespace launch
