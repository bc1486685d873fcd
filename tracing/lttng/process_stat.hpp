// SPDX-License-Identifier: Apache-2.0
// The kernel's description of another process.
#pragma once

#include <sys/types.h>

#include <string>

namespace tracing {

struct ProcessStat {
  std::string name;  // of its program, 15 bytes at most
  char state = '?';  // 'T': stopped, 'Z': ended and not reaped yet
  pid_t parent = 0;
};

// From /proc/PID/stat, proc(5). An empty name when the process can't be seen.
ProcessStat read_process_stat(pid_t pid);

}  // namespace tracing
