// SPDX-License-Identifier: Apache-2.0
// Shared memory of Fast DDS that killed processes have left.
#pragma once

#include <chrono>
#include <string>

namespace rmw_fastrtps {

// Removes the segments of dead participants of this user, and their ports beyond 65535, which are the random ports of
// this stack (shared_memory_ports.hpp). Fast DDS itself replaces what is left of the other ports when they are used
// again. A process that is killed leaves 8 files, and nobody else removes them.
//
// A participant holds a lock (flock(2)) on a file beside each segment and each port as long as its process lives, also
// in a container. Files that are younger than `youngest` are left alone, because a participant makes such a file before
// it locks it. Takes some microseconds for each participant of the machine. Errors are ignored.
void remove_abandoned_memory(const std::string& directory = "/dev/shm",
                             std::chrono::seconds youngest = std::chrono::seconds(5));

}  // namespace rmw_fastrtps
