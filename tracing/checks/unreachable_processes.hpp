// SPDX-License-Identifier: Apache-2.0
// Programs that could be traced and never notice that they may be.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// One warning for each process that has LTTng-UST loaded, sees the session daemon's directory but another /dev/shm
// than we do, and is not registered with the daemon: it started before the daemon and waits, in its own /dev/shm, to be
// woken. Where one /dev/shm is not shared, as between containers, only programs that start after the daemon are
// recorded. Needs a session daemon; takes microseconds for each process of the machine. Throws TraceError.
std::vector<std::string> unreachable_process_warnings();

}  // namespace tracing
