// SPDX-License-Identifier: Apache-2.0
// sched_setattr(2) and sched_getattr(2), for which not all C libraries have declarations.
#pragma once

#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstdint>

namespace launch {

struct SchedulingAttributes {
  std::uint32_t size;
  std::uint32_t policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime;
  std::uint64_t deadline;
  std::uint64_t period;
};

// Of a thread; 0 is the one that calls. Both return 0, or -1 with errno.
inline int set_scheduling(pid_t thread, SchedulingAttributes attributes) {
  attributes.size = sizeof attributes;
  return static_cast<int>(::syscall(SYS_sched_setattr, thread, &attributes, 0));
}

inline int get_scheduling(pid_t thread, SchedulingAttributes& attributes) {
  return static_cast<int>(::syscall(SYS_sched_getattr, thread, &attributes, sizeof attributes, 0));
}

}  // namespace launch
