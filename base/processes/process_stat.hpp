// SPDX-License-Identifier: Apache-2.0
// The kernel's description of another process.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace launch {

struct ProcessStat {
  std::string name;  // of its program, 15 bytes at most
  char state = '?';  // 'T': stopped, 'Z': ended and not reaped yet
  pid_t parent = 0;
  std::uint64_t processor_time = 0;  // clock ticks in user and kernel mode, of all its threads
  std::uint64_t started = 0;         // clock ticks after the boot; with the process number it names a process for good
};

// From /proc/PID/stat, proc(5). An empty name when the process can't be seen.
ProcessStat read_process_stat(pid_t pid);

}  // namespace launch
