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
#include <optional>
#include <utility>

#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"
#include "programs/guardian/clean_ups.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;

// Processes can start others at any time, so the guardian looks again and again.
constexpr milliseconds kBetweenLooks{50};
constexpr milliseconds kBetweenLooksAtKilled{5};
constexpr milliseconds kShortestPause{2};
// So many looks in a row that find nothing are believed where the kernel can't tell.
constexpr int kLooksWithoutProof = 5;
// A spare guardian tells within microseconds that nothing is left. One that does not is no longer waited for.
constexpr std::chrono::seconds kSparePatience{5};
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

}  // namespace

GentleEnd::GentleEnd(LaunchMembers members, GuardianLog& log)
    : members_(std::move(members)), log_(log), output_(log), inherited_(read_inherited_mark(members_.records)) {}

bool GentleEnd::run(const std::string& launcher_ended, int signals) {
  bool ended = true;
  std::optional<Clock::time_point> nothing_since;
  for (int looks = 0; looks < kLooksWithoutProof;) {
    read_signals(signals);
    if (is_proven()) {
      break;
    }
    const std::vector<FoundProcess> found = find();
    Clock::time_point next = Clock::now();
    if (found.empty()) {
      nothing_since = nothing_since.value_or(next);
      const bool waits_for_proof = can_be_proven() && next - *nothing_since < kSparePatience;
      looks = waits_for_proof || has_missed_some() ? 0 : looks + 1;
      next += kBetweenLooksAtKilled;
    } else {
      looks = 0;
      nothing_since.reset();
      if (first_) {
        tell(launcher_ended, found);
      }
      next = signal(found);
      if (hopeless(found)) {
        ended = false;
        break;
      }
    }
    wait(next, signals);
  }
  output_.read(true);
  reap_ended();  // what runs next finds no group of theirs any more
  return ended;
}

bool GentleEnd::is_proven() const {
  if (members_.by_mark) {
    return false;
  }
  if (members_.spare <= 0 && members_.strangers.empty()) {
    return !has_children();
  }
  // A child that has ended is among them until this process reaps it, so none is missed while they are read.
  const std::optional<std::set<pid_t>> children = children_of(::getpid());
  return (members_.spare <= 0 || nothing_below_spare_) && children &&
         std::all_of(children->begin(), children->end(),
                     [this](pid_t child) { return child == members_.spare || members_.strangers.count(child) != 0; });
}

bool GentleEnd::has_missed_some() {
  if (members_.by_mark) {
    return false;
  }
  for (const pid_t parent : {::getpid(), members_.spare}) {
    for (const pid_t pid : parent > 0 ? children_of(parent).value_or(std::set<pid_t>()) : std::set<pid_t>()) {
      const std::optional<FoundProcess> child =
          members_.strangers.count(pid) == 0 ? read_process(pid) : std::optional<FoundProcess>();
      if (child && !child->is_dead() && !ending_of(*child).mark.leave_running) {
        return true;
      }
    }
  }
  return false;
}

void GentleEnd::reap_ended() {
  int status = 0;
  for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG | WUNTRACED)) > 0;) {
    if (!WIFSTOPPED(status)) {
      members_.spare = pid == members_.spare ? -1 : members_.spare;
      members_.strangers.erase(pid);
      if (const pid_t stranger = members_.reaped(pid, status); stranger > 0) {
        members_.strangers.insert(stranger);
      }
    } else if (pid == members_.spare) {
      ::kill(pid, SIGCONT);
    }
  }
}

std::vector<FoundProcess> GentleEnd::find() {
  std::vector<FoundProcess> all = all_processes();
  all.erase(std::remove_if(all.begin(), all.end(),
                           [this](const FoundProcess& process) { return members_.strangers.count(process.pid) != 0; }),
            all.end());
  std::vector<FoundProcess> found =
      members_.by_mark ? marked(all) : descendants(all, {::getpid(), members_.spare > 0 ? members_.spare : ::getpid()});
  const auto stays = [this](const FoundProcess& process) {
    const bool goes_on =
        !process.is_dead() && process.session != members_.session && ending_of(process).mark.leave_running;
    leaves_some_ = leaves_some_ || goes_on;
    return process.is_dead() || goes_on;
  };
  found.erase(std::remove_if(found.begin(), found.end(), stays), found.end());
  for (const FoundProcess& process : found) {
    numbers_.insert(process.pid);
    output_.follow(process, ending_of(process).mark);
  }
  return found;
}

std::vector<FoundProcess> GentleEnd::marked(const std::vector<FoundProcess>& all) {
  std::set<pid_t> roots;
  std::vector<FoundProcess> found;
  const std::set<pid_t> in_cgroup = members_.cgroup.members();
  for (const FoundProcess& process : all) {
    if (process.pid != ::getpid() && !process.is_dead() && !is_guardian(process, members_.launch_id) &&
        (in_cgroup.count(process.pid) != 0 || ending_of(process).mark.ours || inherited_.is_on(process.pid) ||
         holds(process.pid, members_.records))) {
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
    ending.mark = read_mark(process, members_.launch_id);
    if (!ending.mark.ours) {
      ending.mark = noted(process);
    }
  }
  return ending;
}

// A process leads a group with its own number, in which its descendants are.
ProcessMark GentleEnd::noted(const FoundProcess& process) {
  if (!notes_) {
    notes_ = read_notes(members_.records);
  }
  if (members_.by_mark && !inherited_.is_on(process.pid)) {
    return {};  // the number may be that of another process by now
  }
  for (const pid_t pid : {process.pid, process.group}) {
    if (const auto found = notes_->find(pid); found != notes_->end()) {
      return found->second;
    }
  }
  return {};
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
  if (signal != SIGKILL && process.group != members_.group && numbers_.count(process.group) != 0) {
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
    // One of another user has its time as well: it may end by itself.
    if (ending.sent != SIGKILL || (!ending.refused && Clock::now() - ending.sent_at < kHopeless)) {
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
    const bool from_spare = members_.spare > 0 && static_cast<pid_t>(info.ssi_pid) == members_.spare;
    if (from_spare && (number == SIGRTMIN + kNothingLeft || number == SIGRTMIN + kLauncherLeaves)) {
      members_.launcher_ended(info.ssi_int);
      nothing_below_spare_ = nothing_below_spare_ || number == SIGRTMIN + kNothingLeft;
    }
    if (asks_to_end(number) && Clock::now() - last_step_ >= kSameSignal) {
      last_step_ = Clock::now();
      ++steps_;
    }
  }
  // Reaps what has been adopted. The numbers of the spare guardian and of strangers are not waited for by others.
  reap_ended();
}

}  // namespace launch
