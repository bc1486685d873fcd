// SPDX-License-Identifier: Apache-2.0
// Running programs that could be traced, but do not register with the session daemon.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// One warning for each process that has LTTng-UST loaded, sees the directory of the session daemon but another /dev/shm
// than this process, and is not registered. Such a process started before the daemon and waits for a wake-up in its own
// /dev/shm, which the daemon does not see. Without a common /dev/shm, as between containers, only programs that start
// after the daemon are recorded. Needs a session daemon. Takes microseconds for each process of the machine. Throws
// TraceError.
std::vector<std::string> unreachable_process_warnings();

}  // namespace tracing
