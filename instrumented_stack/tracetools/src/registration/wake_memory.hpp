// SPDX-License-Identifier: Apache-2.0
// The memory in /dev/shm with which LTTng's session daemons wake the processes that have started before them.
#pragma once

namespace tracetools {

// The files of the daemon of root, and of the daemon of this process's user.
struct WakeFiles {
  const char* of_root;
  char of_user[64];

  WakeFiles() noexcept;
};

// False when this memory is not there and can't be had, because /dev/shm is full. lttng-ust makes a file of one page
// and reads it; if the page gets no memory, the read ends the process by SIGBUS.
bool wake_memory_can_be_had() noexcept;

}  // namespace tracetools
