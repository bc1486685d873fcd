// SPDX-License-Identifier: Apache-2.0
// Whether somebody in this program continues LTTng's daemons when they are stopped (daemons_kept_going.hpp).
#pragma once

#include <sys/types.h>

namespace tracing {

// Says so in its life. For any thread.
class KeepsGoing {
 public:
  KeepsGoing();
  ~KeepsGoing();
  KeepsGoing(const KeepsGoing&) = delete;
  KeepsGoing& operator=(const KeepsGoing&) = delete;
};

// Whether the process is stopped (SIGSTOP).
bool is_stopped(pid_t pid);

// Returns once the process is not stopped any more, if somebody keeps it going, or after a second. False if it is
// stopped.
bool is_kept_going(pid_t pid);

}  // namespace tracing
