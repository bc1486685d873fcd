// SPDX-License-Identifier: Apache-2.0
// Waits for a session daemon, so that a process that nobody can trace does without lttng-ust: it starts 1.5 to 2 ms
// sooner, and saves a megabyte.
//
// LTTng's session daemons wake the processes that have started before them through files in /dev/shm, one for the
// daemon of root and one for that of each user. The first number in the file is 1 while the daemon runs. A daemon that
// starts wakes all who wait for the number to change (futex(2)).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace tracetools {

// The numbers that this process waits for. For root the second is null, because there is one daemon. They are mapped
// for the life of the process.
using AwaitedDaemons = std::array<const std::int32_t*, 2>;

// Nothing if a session daemon may be there already, or if it is impossible to wait for one: only the daemons of
// LTTng 2.13 are known to wake in this way.
std::optional<AwaitedDaemons> awaited_daemons() noexcept;

// Returns true when the daemon has started, and false if it is impossible to wait, because /dev/shm is full.
bool wait_for_daemon(const std::int32_t* number) noexcept;

// False when this memory is not there and can't be had, because /dev/shm is full. lttng-ust makes a file of one page
// and reads it; if the page gets no memory, the read ends the process by SIGBUS.
bool wake_memory_can_be_had() noexcept;

}  // namespace tracetools
