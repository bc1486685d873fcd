// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/gentle_end.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/processes/ending_signals.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;

// Processes can start others at any time, so the guardian looks again and again.
constexpr milliseconds kBetweenLooks{50};
constexpr milliseconds kBetweenLooksAtKilled{5};
constexpr milliseconds kShortestPause{2};
// A process that has not ended so long after SIGKILL hangs in the kernel.
constexpr std::chrono::seconds kHopeless{10};
// Signals that follow sooner are the same wish.
constexpr std::chrono::seconds kSameSignal{1};
constexpr std::size_t kNamed = 5;

// "sleep (1234), python3 (1235) and 3 more"
std::string list(const std::vector<const FoundProcess*>& processes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(processes.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + processes[i]->name + " (" + std::to_string(processes[i]->pid) + ")";
  }
  if (processes.size() > kNamed) {
    text += " and " + std::to_string(processes.size() - kNamed) + " more";
  }
  return text;
}

std::string count_of(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " process" : " processes");
}

// Of those that this file sends.
const char* name_of(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGKILL";
}

// A process that has been forked and not replaced by its program yet.
bool holds(pid_t pid, int descriptor) {
  struct stat ours {};
  struct stat theirs {};
  const std::string path = "/proc/" + std::to_string(pid) + "/fd/" + std::to_string(descriptor);
  return descriptor >= 0 && ::fstat(descriptor, &ours) == 0 && ::stat(path.c_str(), &theirs) == 0 &&
         ours.st_ino == theirs.st_ino && ours.st_dev == theirs.st_dev;
}

// When the kernel would say that a process has started that starts at this time.
std::uint64_t tick_of(std::chrono::steady_clock::time_point time) {
  static const long ticks_in_second = ::sysconf(_SC_CLK_TCK);
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  const auto since_boot = std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec) -
                          (std::chrono::steady_clock::now() - time);
  return static_cast<std::uint64_t>(since_boot * ticks_in_second / std::chrono::seconds(1));
}

void reap_ended() {
  while (::waitpid(-1, nullptr, WNOHANG) > 0) {
  }
}

}  // namespace

bool GentleEnd::run(const std::string& launcher_ended, int signals) {
  // A process can slip through one look at /proc when its number is smaller than that of the process that started it.
  const int looks_without = members_.by_mark ? 2 : 1;
  bool ended = true;
  for (int looks = 0; looks < looks_without;) {
    read_signals(signals);
    const std::vector<FoundProcess> found = find();
    Clock::time_point next = Clock::now();
    if (found.empty()) {
      ++looks;
      next += kBetweenLooksAtKilled;
    } else {
      looks = 0;
      if (first_) {
        tell(launcher_ended, found);
      }
      next = signal(found);
      if (hopeless(found)) {
        ended = false;
        break;
      }
    }
    if (looks < looks_without) {
      wait(next, signals);
    }
  }
  output_.read(true);
  reap_ended();  // what runs next finds no group of theirs any more
  return ended;
}

std::vector<FoundProcess> GentleEnd::find() {
  std::vector<FoundProcess> all = all_processes();
  all.erase(std::remove_if(all.begin(), all.end(),
                           [this](const FoundProcess& process) { return members_.strangers.count(process.pid) != 0; }),
            all.end());
  std::vector<FoundProcess> found = members_.by_mark ? marked(all) : descendants(all, {::getpid()});
  const auto stays = [this](const FoundProcess& process) {
    const bool goes_on =
        !process.is_dead() && process.session != members_.session && ending_of(process).mark.leave_running;
    leaves_some_ = leaves_some_ || goes_on;
    return process.is_dead() || goes_on;
  };
  found.erase(std::remove_if(found.begin(), found.end(), stays), found.end());
  for (const FoundProcess& process : found) {
    output_.follow(process.pid, ending_of(process).mark);
  }
  return found;
}

std::vector<FoundProcess> GentleEnd::marked(const std::vector<FoundProcess>& all) {
  std::set<pid_t> roots;
  std::vector<FoundProcess> found;
  const std::set<pid_t> in_cgroup = members_.cgroup.members();
  for (const FoundProcess& process : all) {
    if (process.pid != ::getpid() && !process.is_dead() &&
        (in_cgroup.count(process.pid) != 0 || ending_of(process).mark.ours || holds(process.pid, members_.records))) {
      roots.insert(process.pid);
      found.push_back(process);
    }
  }
  const std::vector<FoundProcess> below = descendants(all, roots);
  found.insert(found.end(), below.begin(), below.end());
  return found;
}

GentleEnd::Ending& GentleEnd::ending_of(const FoundProcess& process) {
  Ending& ending = endings_[process.pid];
  if (ending.started != process.started) {
    ending = {.started = process.started, .name = process.name};
  }
  if (!ending.mark.ours) {
    ending.mark = read_mark(process.pid, members_.launch_id);
  }
  return ending;
}

void GentleEnd::tell(const std::string& launcher_ended, const std::vector<FoundProcess>& found) {
  if (!launcher_ended.empty()) {
    log_.say("ERROR", launcher_ended + ": ending " + count_of(found.size()));
    return;
  }
  std::map<std::string, std::vector<const FoundProcess*>> left;
  for (const FoundProcess& process : found) {
    if (!process.dying && !is_being_killed(process.pid)) {
      const std::string& label = ending_of(process).mark.label;
      left[label.empty() ? "the launch" : label].push_back(&process);
    }
  }
  for (const auto& [label, processes] : left) {
    log_.say("WARNING", label + " left " + count_of(processes.size()) + " running: " + list(processes) +
                            (processes.size() == 1 ? "; ending it" : "; ending them"));
  }
}

GentleEnd::Clock::time_point GentleEnd::signal(const std::vector<FoundProcess>& found) {
  const Clock::time_point now = Clock::now();
  Clock::time_point next = now + kBetweenLooks;
  bool kills_all = !leaves_some_;
  std::map<std::pair<int, int>, std::vector<const FoundProcess*>> escalated;  // the signal before and the new one
  for (const FoundProcess& process : found) {
    Ending& ending = ending_of(process);
    const Clock::time_point terminate = begin_ + milliseconds(ending.mark.sigterm_timeout);
    const Clock::time_point kill = terminate + milliseconds(ending.mark.sigkill_timeout);
    const int due = now >= kill || steps_ >= 2 ? SIGKILL : now >= terminate || steps_ >= 1 ? SIGTERM : SIGINT;
    if (due == SIGKILL) {
      next = now + kBetweenLooksAtKilled;
    } else {
      kills_all = false;
      next = std::min(next, due == SIGTERM ? kill : terminate);
    }
    if (ending.sent != due) {
      const int before = std::exchange(ending.sent, due);
      const bool is_new = before == 0;
      ending.sent_at = now;
      const Clock::time_point asked = due == SIGINT ? begin_
                                      : steps_ >= 1 ? std::min(last_step_, terminate)
                                                    : terminate;
      if (due == SIGKILL || first_ || !is_new || process.started < tick_of(asked)) {
        ending.refused = !send(process, due);
      }
      if (!is_new && !ending.refused) {
        escalated[{before, due}].push_back(&process);
      }
    }
  }
  if (kills_all) {
    members_.cgroup.kill();
  }
  for (const auto& [signals, processes] : escalated) {
    log_.say("WARNING", count_of(processes.size()) + (processes.size() == 1 ? " has" : " have") + " not ended after " +
                            name_of(signals.first) + ", sending " + name_of(signals.second) + ": " + list(processes));
  }
  first_ = false;
  return next;
}

bool GentleEnd::send(const FoundProcess& process, int signal) {
  pid_t to = process.pid;
  if (signal != SIGKILL && process.group != members_.group && endings_.count(process.group) != 0) {
    if (!asked_groups_.emplace(process.group, signal).second) {
      return true;  // it was asked with its group, or has been started later
    }
    to = -process.group;
  }
  const bool refused = ::kill(to, signal) != 0 && errno == EPERM;
  if (signal != SIGKILL) {
    ::kill(to, SIGCONT);  // a stopped process would not see the signal
  }
  return !refused;
}

bool GentleEnd::hopeless(const std::vector<FoundProcess>& found) {
  std::vector<const FoundProcess*> left;
  bool foreign = false;
  for (const FoundProcess& process : found) {
    const Ending& ending = ending_of(process);
    if (!ending.refused && (ending.sent != SIGKILL || Clock::now() - ending.sent_at < kHopeless)) {
      return false;
    }
    foreign = foreign || ending.refused;
    left.push_back(&process);
  }
  log_.say("ERROR", "cannot end " + list(left) +
                        (foreign ? ": another user owns what is left" : ": what is left hangs in the kernel"));
  return true;
}

void GentleEnd::wait(Clock::time_point until, int signals) {
  const Clock::time_point earliest = Clock::now() + kShortestPause;
  until = std::max(until, earliest);
  for (Clock::time_point now; (now = Clock::now()) < until;) {
    const auto left = std::chrono::ceil<milliseconds>(until - now).count();
    std::vector<pollfd> descriptors{{signals, POLLIN, 0}};  // poll(2) skips a negative descriptor
    output_.add_to(descriptors);
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(left));
    output_.read();
    if (descriptors[0].revents != 0) {
      until = std::min(until, earliest);
      read_signals(signals);
    }
  }
}

void GentleEnd::read_signals(int signals) {
  signalfd_siginfo info{};
  while (signals >= 0 && ::read(signals, &info, sizeof info) == sizeof info) {
    const int number = static_cast<int>(info.ssi_signo);
    if (asks_to_end(number) && Clock::now() - last_step_ >= kSameSignal) {
      last_step_ = Clock::now();
      ++steps_;
    }
  }
  // Reaps what has been adopted. The numbers of the spare guardian and of strangers are not waited for by others.
  reap_ended();
}

}  // namespace launch
