// SPDX-License-Identifier: Apache-2.0
// The verdict of a trace of several machines: never more optimistic than that of its worst part.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tracing {

// The recording of one machine.
struct MachinePart {
  std::string machine;
  std::string folder = {};      // below the directory of the trace, with a verdict of its own; empty: it is not there
  std::string problem = {};     // a sentence; empty: none
  std::string left_there = {};  // the directory on the machine, if it was not fetched
  bool nothing = false;         // nothing was recorded there, and nothing was to be
};

// Why a snapshot of several machines was taken, and when that was, in nanoseconds since the epoch by the clock of the
// launch.
struct SnapshotReasons {
  std::vector<std::string> reasons;
  std::int64_t time_ns = 0;
};

// Writes kVerdictFile into the directory, which is made if need be: session, complete, absent (the problems), machines
// with what their own verdicts say, and of a snapshot its reasons and time. A part without a verdict is not complete.
// Returns whether all are. Throws TraceError.
bool write_machines_verdict(const std::filesystem::path& directory, const std::string& session_name,
                            const std::vector<MachinePart>& parts, const SnapshotReasons* snapshot = nullptr);

// Adds problems to the verdict of a recording, which is not complete then. Throws TraceError.
void note_problems(const std::filesystem::path& directory, const std::vector<std::string>& problems);

}  // namespace tracing
