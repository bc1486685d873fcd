// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/launch_rest.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "launcher/process/guardian/guardian_protocol.hpp"
#include "programs/guardian/launch_cgroup.hpp"

namespace launch {
namespace {

constexpr int kExitCodeOfSignal = 128;  // plus its number, as shells count

}  // namespace

UniqueFd open_process(pid_t pid) {
  return UniqueFd(pid <= 0 ? -1 : static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
}

bool has_ended(const UniqueFd& process) {
  pollfd ended{process.get(), POLLIN, 0};
  return !process || ::poll(&ended, 1, 0) == 1;
}

void send_signal(const UniqueFd& process, int signal) {
  if (process) {
    ::syscall(SYS_pidfd_send_signal, process.get(), signal, nullptr, 0);
  }
}

LaunchMembers members_below(const GuardedLaunch& launch) {
  LaunchMembers members;
  members.launch_id = launch.id;
  members.group = launch.group;
  members.session = launch.session;
  members.strangers = launch.strangers;
  members.records = launch.records;
  return members;
}

bool end_rest(const GuardedLaunch& launch, LaunchMembers members, bool nothing_left, const std::string& launcher_ended,
              int signals) {
  const LeftWork work = read_records(launch.records);
  GuardianLog log;
  if (!work.log.empty()) {
    log.open(work.log);
  }
  bool ended_all = true;
  if (!nothing_left) {
    members.cgroup = LaunchCgroup::find(launch.id);
    const LaunchCgroup cgroup = members.cgroup;
    ended_all = GentleEnd(std::move(members), log).run(launcher_ended, signals);
    cgroup.remove();
  }
  run_clean_ups(launch.records, work, log, signals);
  return ended_all;
}

void run_clean_ups(int records, const LeftWork& work, GuardianLog& log, int signals) {
  for (auto command = work.clean_ups.rbegin(); command != work.clean_ups.rend(); ++command) {
    if (const std::string failure = run_clean_up(command->second, signals); !failure.empty()) {
      log.say("ERROR", failure);
    }
    const GuardianRecord done{GuardianRecord::Kind::kRemoveCleanUp, command->first, 0};
    static_cast<void>(!::write(records, &done, sizeof done));
  }
}

std::string launcher_ended(int status) {
  if (!WIFSIGNALED(status)) {
    return "";
  }
  const char* const name = ::sigabbrev_np(WTERMSIG(status));
  return std::string("the launcher was ended by ") + (name == nullptr ? "a signal" : std::string("SIG") + name);
}

UniqueFd watch_signals() {
  sigset_t watched;
  sigfillset(&watched);
  for (const int signal : {SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGSEGV, SIGSYS, SIGTRAP, SIGTTIN, SIGTTOU}) {
    sigdelset(&watched, signal);
  }
  struct sigaction action {};
  if (::sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) {
    sigdelset(&watched, SIGHUP);
  }
  return UniqueFd(::signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK));
}

void end_with(int status) {
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

}  // namespace launch
