// SPDX-License-Identifier: Apache-2.0
// Ends what a launcher has left: SIGINT, then SIGTERM and SIGKILL after the timeouts of each process, until none is
// there.
//
// That none is there is no matter of a look at /proc, which can miss a process that starts another one and ends. The
// kernel tells it: a process that adopts orphans, and has no child, has no descendants. Only where that can't be,
// because some processes are meant to go on, or because this process has not adopted them, several looks in a row must
// find nothing.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/guardian/inherited_mark.hpp"
#include "launcher/process/guardian/process_scan.hpp"
#include "programs/guardian/guardian_log.hpp"
#include "programs/guardian/launch_cgroup.hpp"

namespace launch {

// Which processes belong to the launch.
struct LaunchMembers {
  std::string launch_id;
  pid_t group = 0;              // of the launcher, which may hold other programs of a shell
  pid_t session = 0;            // of the launcher
  std::set<pid_t> strangers{};  // these and their descendants are not ours
  // False: all descendants of this process. True: this process has not adopted them, so the processes with the mark of
  // the launch (inherited or in their environment), those that still have the launcher's descriptor of the records, and
  // all their descendants.
  bool by_mark = false;
  int records = -1;
  LaunchCgroup cgroup{};  // further members, where there is one
  // The spare guardian, a child of this process that adopts orphans before this process does, and tells by a signal
  // when it has no child any more (guardian_protocol.hpp); -1: none.
  pid_t spare = -1;
  // Told of each child that has ended, with its wait status. Returns a further stranger that it has started, or -1.
  std::function<pid_t(pid_t pid, int status)> reaped = [](pid_t, int) { return -1; };
  // Told when the spare tells how the launcher has ended.
  std::function<void(int status)> launcher_ended = [](int) {};
};

class GentleEnd {
 public:
  GentleEnd(LaunchMembers members, GuardianLog& log);

  // Returns false when a process could not be ended, which the log says then. `launcher_ended` is what has happened to
  // the launcher, such as "the launcher was killed by SIGKILL". Empty: it has ended by itself, and each process that it
  // left is named. `signals` is a signalfd with SIGCHLD and the signals that a user sends, or -1; each of the latter
  // takes the end a step further.
  bool run(const std::string& launcher_ended, int signals);

 private:
  using Clock = std::chrono::steady_clock;

  // One process on its way to its end.
  struct Ending {
    std::uint64_t started = 0;
    ProcessMark mark{};
    std::string name{};
    int sent = 0;          // the last signal
    bool refused = false;  // it belongs to another user
    Clock::time_point sent_at{};
  };

  // Whether the kernel says that nothing is left.
  bool is_proven() const;
  // Whether it will say so.
  bool can_be_proven() const { return members_.spare > 0 && !leaves_some_; }
  // A look has found nothing. Whether some child is there that it ought to have found.
  bool has_missed_some();
  void reap_ended();
  // What the launcher has noted about a process whose environment tells nothing.
  ProcessMark noted(const FoundProcess& process);
  std::vector<FoundProcess> find();
  std::vector<FoundProcess> marked(const std::vector<FoundProcess>& all);
  Ending& ending_of(const FoundProcess& process);
  void tell(const std::string& launcher_ended, const std::vector<FoundProcess>& found);
  // Sends the signals that are due. Returns when to look again. A signal that asks goes to whole groups, so that nobody
  // gets it twice or is missed. What a process starts while it cleans up is not asked.
  Clock::time_point signal(const std::vector<FoundProcess>& found);
  // False when the process belongs to another user.
  bool send(const FoundProcess& process, int signal);
  bool hopeless(const std::vector<FoundProcess>& found);
  void wait(Clock::time_point until, int signals);
  void read_signals(int signals);

  LaunchMembers members_;
  GuardianLog& log_;
  LeftOutput output_;
  InheritedMark inherited_;
  std::map<pid_t, Ending> endings_;
  std::optional<std::map<pid_t, ProcessMark>> notes_;  // once they have been read
  std::set<pid_t> numbers_;  // of all that were found: only their groups are signalled, never one of a foreign process
  std::set<std::pair<pid_t, int>> asked_groups_;  // and the signals that they got
  Clock::time_point begin_ = Clock::now();
  bool first_ = true;
  bool leaves_some_ = false;          // that are meant to go on
  bool nothing_below_spare_ = false;  // as it has told
  int steps_ = 0;                     // 1: SIGTERM now, 2: SIGKILL now
  Clock::time_point last_step_{};
};

}  // namespace launch
