// SPDX-License-Identifier: Apache-2.0
// Which processes have missed a deadline, from the snapshot that a flight recorder has made of it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace launch {

// The processes that have recorded one of these events (names, also with `*`), and the time of their last one in
// nanoseconds. Runs launch-trace-read, for some seconds at most. Empty as well when the trace does not say which
// process an event is from.
std::map<pid_t, std::int64_t> late_processes(const std::filesystem::path& snapshot,
                                             const std::vector<std::string>& events, const std::atomic<bool>& hurry);

// The same from what `launch-trace-read --format csv` has written.
std::map<pid_t, std::int64_t> late_processes_of(std::istream& csv);

}  // namespace launch
