// SPDX-License-Identifier: Apache-2.0
// A directory that holds what is known of one crash, for those who look at it later or elsewhere.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "launcher/process/process_spec.hpp"

namespace launch {

// Also of a process that runs on, but has missed a deadline.
struct Crash {
  std::string process;  // its label, "talker-1"
  pid_t pid = 0;
  ProcessExit exit;
  std::chrono::system_clock::time_point time;
  std::string place;  // "/home/ada/system.launch.xml:7:3"; empty: unknown
  std::vector<std::string> argv;
  bool shell = false;
  std::map<std::string, std::string> environment;
  std::string directory;                // its working directory
  std::vector<std::string> last_lines;  // of its output
};

// Makes PARENT/talker-1-20261124-001530-1234 for its owner alone, and returns its path. It holds
// - crash.txt: how the process ended, where it was asked for, what it ran, what its core says;
// - backtrace.txt: every thread, by gdb; or what is missing for that;
// - core and maps.txt, if the kernel has written a core that can be found: the core is moved;
// - output.log: the last lines;
// - command.sh, which runs the command again, in its directory and environment, and parameters/, copies of the files
//   after --params-file that it then reads.
// Takes seconds when there is a core. Throws std::filesystem::filesystem_error when the directory can't be made.
std::filesystem::path write_crash_bundle(const Crash& crash, const std::filesystem::path& parent,
                                         const std::atomic<bool>& hurry);

// Makes a directory as above for a process that has missed a deadline, or is unhealthy, and runs on, with `reasons`,
// sentences that say what is wrong. It holds
// - the file of this name (deadline.txt, health.txt): the reasons, and what crash.txt says of the process;
// - threads.txt: the threads of the process, and what each waits for in the kernel. The process is not stopped;
// - maps.txt, output.log and command.sh, as above.
std::filesystem::path write_deadline_bundle(const Crash& late, const std::vector<std::string>& reasons,
                                            const std::filesystem::path& parent,
                                            const std::string& file = "deadline.txt");

// Adds the events before the crash: `snapshot`, with hard links where that is possible.
void add_snapshot(const std::filesystem::path& bundle, const std::filesystem::path& snapshot);

}  // namespace launch
