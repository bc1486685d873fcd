// SPDX-License-Identifier: Apache-2.0
// What launch-guardian learns from the launcher. The guardian reads it when the launcher has gone, and not before:
// nothing can be lost, and nothing makes the launcher wait.
//
// - The environment of each process holds its mark (process_mark.hpp). A process has it before its first instruction,
//   and its descendants inherit it.
// - A memory file holds the clean-up commands and the path of launch.log.
//
//   launch-guardian ID LAUNCHER RECORDS READY CHILDREN -- WORD…
//
// ID is the number of the launch, LAUNCHER the process number of the launcher, RECORDS the descriptor of the memory
// file, READY that of a pipe that is closed when the spare guardian is out of reach of signals to the process group,
// CHILDREN the process numbers of children that the program had before, with commas. WORD… is the command line of
// the launcher, for a reader of ps(1). A launcher that ends after guardian and spare were killed starts a spare again:
// "--after" stands in the place of "--" then, and READY is -1.
#pragma once

#include <cstdint>

namespace launch {

// The memory file is a series of records. The last one may be incomplete.
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

}  // namespace launch
