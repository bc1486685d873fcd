// SPDX-License-Identifier: Apache-2.0
// What the launcher has left to be done, read from the records.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "launcher/process/guardian/inherited_mark.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {

struct LeftWork {
  std::map<std::int32_t, std::vector<std::string>> clean_ups;
  std::string log;  // the path of launch.log, "" when there is none yet
};

// Reads the memory file from its beginning.
LeftWork read_records(int file);

// The table of the memory file, by process number: what marks would say.
std::map<pid_t, ProcessMark> read_notes(int file);

InheritedMark read_inherited_mark(int file);

// Runs a command. Returns what went wrong, or "". A command that makes no progress for ten seconds, or takes two
// minutes, is killed, and so is one that runs when a user asks to end again. `signals` is a signalfd with the signals
// of users, or -1.
std::string run_clean_up(const std::vector<std::string>& command, int signals);

}  // namespace launch
