// SPDX-License-Identifier: Apache-2.0
// What the kernel says of processes that it has ended for want of memory.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <string_view>

namespace launch {

// Whether the kernel's log says that its OOM killer has ended this process, not earlier than `since` on
// CLOCK_MONOTONIC. False where the user may not read the log. It takes as long as the log is full, some milliseconds at
// most.
bool ended_for_want_of_memory(pid_t pid, std::chrono::nanoseconds since, const std::string& log = "/dev/kmsg");

// The same of one record: "6,1234,5678901,-;Out of memory: Killed process 42 (name) …". Its third number is the time in
// microseconds.
bool tells_of_end(std::string_view record, pid_t pid, std::chrono::nanoseconds since);

}  // namespace launch
