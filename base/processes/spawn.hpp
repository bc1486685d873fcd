// SPDX-License-Identifier: Apache-2.0
// Starts another program, as posix_spawn(3) does.
//
//   const pid_t pid = spawn({
//       .program = "/usr/bin/sort",
//       .argv = {"sort", "-n"},
//       .descriptors = {{STDIN_FILENO, pipe.read.get()}, {STDERR_FILENO, kDevNull}},
//   });
//   const int status = wait_for(pid);
//
// Everything that is left out stays as in this process: descriptors, environment, directory, process group, signals.
// Threads do no harm: only the calling thread waits until the program runs, whereas fork(2) would copy a process in
// which other threads may hold locks. The child shares the memory until then, so a start costs the same in a large
// process as in a small one. With `only_given_descriptors` it also costs the same whatever number of descriptors is
// open.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace launch {

// Stands in place of a descriptor of this process for /dev/null.
constexpr int kDevNull = -2;

// A descriptor that the child gets.
struct ChildDescriptor {
  int number;  // in the child
  // The descriptor of this process to copy, close-on-exec or not, or kDevNull. It must be greater than the numbers of
  // the descriptors before it in the list: one of them would have replaced it otherwise.
  int source;
};

enum class ChildGroup {
  kOurs,
  kOwn,         // the child leads a new process group, so a Ctrl-C on the terminal does not reach it
  kOwnSession,  // it also has no terminal, so a hang-up of the terminal does not reach it
  kOwnTerminal  // it leads a session on the terminal that is its standard input
};

enum class ChildSignals {
  kInherited,
  kNoneBlocked,
  kFresh,      // none blocked and none ignored, as a program expects it
  kAllBlocked  // until the child has chosen which signals it ignores
};

struct ChildProgram {
  std::string program;            // a path, or with `search_path` a name to look for in PATH
  std::vector<std::string> argv;  // the first word is the name by which the program is called
  bool search_path = false;
  const std::map<std::string, std::string>* environment = nullptr;  // nullptr: the environment of this process
  std::string mark;       // "LAUNCH_PROCESS=…", on top of `environment`; "": the mark of this process, if it has one
  std::string directory;  // "": the directory of this process
  std::vector<ChildDescriptor> descriptors;
  bool only_given_descriptors = false;  // closes all others from 3 on, even those that are not close-on-exec
  std::optional<rlimit> open_files;     // RLIMIT_NOFILE of the child
  ChildGroup group = ChildGroup::kOurs;
  ChildSignals signals = ChildSignals::kInherited;
};

// The program could not be started. code() is the reason as errno: ENOENT, EACCES, E2BIG, …
class SpawnError : public std::system_error {
 public:
  // "cannot start 'PROGRAM': REASON".
  SpawnError(int error, const std::string& program);
};

// Returns the process id. The new program already runs then, so errors of exec are thrown as SpawnError, too. The
// caller waits for the process.
pid_t spawn(const ChildProgram& child);

// Waits until the process has ended and reaps it. Its status is to be read with WIFEXITED and others, see waitpid(2).
int wait_for(pid_t pid);

// Waits at most `limit` for the end of the process; false when it still runs then. Does not reap a child.
bool ends_within(pid_t pid, std::chrono::milliseconds limit);

}  // namespace launch
