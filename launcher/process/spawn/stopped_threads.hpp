// SPDX-License-Identifier: Apache-2.0
// Waits until a signal has stopped processes. kill(2) returns before the threads have seen the signal.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <vector>

namespace launch {

// Whether each thread of each process is stopped or has ended. Processes need not be children: the kernel reports
// stops of other processes to nobody, so this looks into /proc every millisecond. False after `limit`.
bool wait_until_stopped(const std::vector<pid_t>& processes, std::chrono::milliseconds limit);

}  // namespace launch
