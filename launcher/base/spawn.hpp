// SPDX-License-Identifier: Apache-2.0
// Starts another program with posix_spawn(3).
//
//   const pid_t pid = spawn({
//       .program = "/usr/bin/sort",
//       .argv = {"sort", "-n"},
//       .descriptors = {{STDIN_FILENO, pipe.read.get()}, {STDERR_FILENO, kDevNull}},
//   });
//   const int status = wait_for(pid);
//
// What is left out stays as it is in this process: descriptors, environment, directory, process group, signals. Threads
// do no harm: posix_spawn stops the calling thread alone until the program runs, where fork(2) would copy a process in
// which other threads may hold locks. The child shares the memory until then, so a start costs the same in a large
// process as in a small one.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>
#include <system_error>
#include <vector>

namespace launch {

// In place of a descriptor of this process.
constexpr int kDevNull = -2;

// A descriptor that the child gets.
struct ChildDescriptor {
  int number;  // in the child
  // The descriptor of this process that it is a copy of, close-on-exec or not, or kDevNull. It is greater than the
  // numbers of the descriptors before it in the list, which would be in its place otherwise.
  int source;
};

enum class ChildGroup {
  kOurs,
  kOwn,        // a process group that it leads: a Ctrl-C on the terminal is not for it
  kOwnSession  // has no terminal either, so a hang-up of the terminal does not reach it
};

enum class ChildSignals {
  kInherited,
  kNoneBlocked,
  kFresh,      // none blocked and none ignored, as a program expects it
  kAllBlocked  // until it has chosen which ones it ignores
};

struct ChildProgram {
  std::string program;            // a path; a name that is looked for in PATH with `search_path`
  std::vector<std::string> argv;  // the name by which the program is called comes first
  bool search_path = false;
  const std::map<std::string, std::string>* environment = nullptr;  // nullptr: that of this process
  std::string directory;                                            // "": that of this process
  std::vector<ChildDescriptor> descriptors;
  bool only_standard_descriptors = false;  // closes all others from 3 on, even those that are not close-on-exec
  ChildGroup group = ChildGroup::kOurs;
  ChildSignals signals = ChildSignals::kInherited;
};

// The program could not be started. code() is the reason as errno: ENOENT, EACCES, E2BIG, …
class SpawnError : public std::system_error {
 public:
  // "cannot start 'PROGRAM': REASON".
  SpawnError(int error, const std::string& program);
};

// Its process number. When this returns the new program runs already: errors of exec, too, are thrown as SpawnError.
// The caller waits for the process.
pid_t spawn(const ChildProgram& child);

// Waits until the process has ended and reaps it. Its status is to be read with WIFEXITED and others, see waitpid(2).
int wait_for(pid_t pid);

// Waits until the process has ended, for `limit` at most; false when it still runs then. A child is not reaped yet.
bool ends_within(pid_t pid, std::chrono::milliseconds limit);

}  // namespace launch
