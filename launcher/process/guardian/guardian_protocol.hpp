// SPDX-License-Identifier: Apache-2.0
// What launch-guardian learns from the launcher. The guardian reads it when the launcher has gone, and not before:
// nothing can be lost, and nothing makes the launcher wait.
//
// - The environment of each process holds its mark (process_mark.hpp). A process has it before its first instruction,
//   and its descendants inherit it. A process can empty its environment, so there is an inherited mark, too.
// - A memory file holds a table of the processes, for those whose environment can't be read, then the place of Python
//   in the launcher, and behind it the clean-up commands and the path of launch.log.
//
//   launch-guardian ID LAUNCHER OTHER RECORDS READY CHILDREN -- WORD…
//
// ID is the number of the launch, LAUNCHER the process number of the launcher, OTHER that of the spare guardian, which
// is the child of the guardian and the parent of the launcher. RECORDS is the descriptor of the memory file, READY that
// of a pipe that is closed when both are ready, CHILDREN the process numbers of children that the program had before,
// with commas. WORD… is the command line of the launcher, for a reader of ps(1).
//
// "--between" stands in the place of "--" for the spare guardian, and OTHER is the guardian. A launcher that ends after
// both were killed starts a spare again: it has "--after", and OTHER and READY are -1.
//
// A contained launch (containment.hpp) has two more of them:
//
//   launch-guardian contained FIRST -1 RECORDS SOCKET -1 --outside WORD…
//   launch-guardian contained GUARDIAN -1 RECORDS SOCKET ALIVE --first
//
// The first process of the namespace tells the one outside through SOCKET when the launch is stopped or has ended, as a
// ContainedNews. ALIVE is a pipe that ends when launcher, guardian and spare have gone.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

#include "base/processes/python_at_work.hpp"

namespace launch {

// A line of the table, at the number of the process in the launch. All zero: there is none.
struct GuardianEntry {
  std::int32_t pid;
  char on_screen;                // 1: standard output, 2: standard error
  char label[43];                // ends with zero, cut if need be
  std::int64_t sigterm_timeout;  // milliseconds
  std::int64_t sigkill_timeout;
};
constexpr std::size_t kGuardianEntries = 16384;  // further processes are not in the table
// Behind the table: the value of the inherited mark (inherited_mark.hpp), eight bytes.
constexpr off_t kGuardianMark = kGuardianEntries * sizeof(GuardianEntry);
// Then where Python is in the launcher, a PythonAtWork, and what it writes when it ends the launcher. Pages have at
// most 64 KiB.
constexpr off_t kLargestPage = 64L << 10U;
constexpr off_t kGuardianPython = kGuardianMark + kLargestPage;
constexpr off_t kGuardianPythonTraces = kGuardianPython + kLargestPage;
constexpr off_t kGuardianRecords = kGuardianPythonTraces + static_cast<off_t>(kPythonTraces);

// The rest of the memory file is a series of records. The last one may be incomplete.
struct GuardianRecord {
  enum class Kind : std::int32_t {
    kAddCleanUp = 1,     // the words of a command follow, each with a zero byte at its end
    kRemoveCleanUp = 2,  // nothing follows
    kLog = 3             // the path of launch.log follows
  };

  Kind kind;
  std::int32_t id;     // of a clean-up command
  std::uint32_t size;  // bytes that follow
};

// The spare guardian tells the guardian so much about the launcher, by a signal with a value. The numbers count from
// SIGRTMIN.
constexpr int kLauncherStopped = 3;  // by Ctrl-Z: the guardian stops, too
constexpr int kLauncherLeaves = 4;   // the launcher has ended with this wait status, and something is left
constexpr int kNothingLeft = 5;      // the launcher has ended with this wait status, and nothing is left any more

// The roles of the two in a contained launch.
constexpr const char* kStandsOutside = "--outside";
constexpr const char* kIsFirst = "--first";

struct ContainedNews {
  enum class Kind : std::int32_t {
    kStopped = 1,  // by Ctrl-Z
    kEnded = 2     // and nothing is left
  };

  Kind kind;
  std::int32_t status;  // of the guardian, as of wait(2)
};

}  // namespace launch
