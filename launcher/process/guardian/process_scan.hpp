// SPDX-License-Identifier: Apache-2.0
// Finds the processes of a launch in /proc.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace launch {

// What the environment of a process says about it.
struct ProcessMark {
  bool ours = false;  // the mark has the number of this launch
  bool leave_running = false;
  std::int64_t sigterm_timeout = 5000;  // milliseconds
  std::int64_t sigkill_timeout = 5000;
  bool out_on_screen = false;
  bool error_on_screen = false;
  std::string label;  // "" when it is not known
};

struct FoundProcess {
  pid_t pid = 0;
  pid_t parent = 0;
  pid_t group = 0;
  pid_t session = 0;
  std::uint64_t started = 0;  // with the process number it names a process for good
  char state = '?';           // of the main thread
  long threads = 1;           // that have not ended; the main one counts in any case
  bool dying = false;         // has been killed, or is about to end
  std::string name;

  // A process whose main thread has ended runs on as long as another thread does.
  bool is_dead() const { return (state == 'Z' || state == 'X') && threads <= 1; }
  bool is_stopped() const { return state == 'T' || state == 't'; }  // or traced
};

// The bytes of a file whose size the kernel does not tell; empty when there is none.
std::string read_whole_file(const std::string& path);
// The bytes of /proc/PID/NAME; empty when the process has gone.
std::string read_proc_file(pid_t pid, const char* name);

// Nothing when the process has gone.
std::optional<FoundProcess> read_process(pid_t pid);
// All processes that this user can see, in the order of their numbers.
std::vector<FoundProcess> all_processes();

// The children of a process with one thread; nullopt when the kernel does not tell. Much quicker than a look at all
// processes.
std::optional<std::set<pid_t>> children_of(pid_t pid);
// Whether this process has a child, alive or not reaped. It adopts orphans, so without one nothing descends from it:
// the kernel knows, where a look into /proc could miss a process that has just started another one and ended.
bool has_children();

// Where /proc shows what belongs to the whole process. Below PID it is empty when the main thread has ended.
std::string proc_directory(const FoundProcess& process);

// The processes that descend from one of `roots`, without the roots.
std::vector<FoundProcess> descendants(const std::vector<FoundProcess>& all, const std::set<pid_t>& roots);

// Reads the environment of the process. A process of another user, one that must not be looked into
// (PR_SET_DUMPABLE), and one that has overwritten its environment, have the mark of no launch.
ProcessMark read_mark(const FoundProcess& process, const std::string& launch_id);

// Whether it is a guardian of this launch, one that is about to become a spare as well.
bool is_guardian(const FoundProcess& process, const std::string& launch_id);

// Whether SIGKILL has been sent to the process, which has not died yet.
bool is_being_killed(pid_t pid);

}  // namespace launch
