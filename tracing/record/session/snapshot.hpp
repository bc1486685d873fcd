// SPDX-License-Identifier: Apache-2.0
// The output of snapshot sessions, and recording one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// What the directories of snapshots begin with.
inline constexpr const char* kSnapshotName = "snapshot";

// Where the snapshots of `config`'s session go. Each makes a directory of its own below the trace directory.
void add_snapshot_output(const TraceConfig& config);

// The directory of the snapshots of a session; nothing if the session takes none or sends them over the network.
std::optional<std::filesystem::path> snapshot_directory(const std::string& lttng_session_name);
// The snapshots in it, from the oldest to the newest.
std::vector<std::filesystem::path> snapshots_in(const std::filesystem::path& directory);

// The directory of the kernel recorder of a session: beside the recorded trace or beside the snapshots. "" if there is
// no such session, the address of the relay daemon if it sends its trace there.
std::string recorder_directory(const std::string& lttng_session_name);

struct SnapshotMoment {
  std::uint64_t asked = 0;             // the result of record_snapshot()
  std::vector<std::string> died = {};  // the processes whose deaths are its reasons
  // When the first reason was there (CLOCK_MONOTONIC, ns): a snapshot that does not reach back so far is incomplete.
  // 0: unknown.
  std::int64_t of_reason = 0;
};

// Writes the verdict of a snapshot into its directory. `counters` is where the processes of the session count their
// events, or "". Returns a sentence on what was not written, or "". Throws
// TraceError.
std::string judge_snapshot(const std::filesystem::path& snapshot, const std::string& lttng_session_name,
                           const std::string& counters, const std::vector<std::string>& reasons,
                           const SnapshotMoment& moment);

// Writes what the buffers of the session hold, and those of its kernel recorder. Returns when it was asked for
// (CLOCK_MONOTONIC, ns): the snapshot shall hold what was before. Throws TraceError.
std::uint64_t record_snapshot(const std::string& lttng_session_name);
// Records a snapshot, then empties the buffers, so that the next snapshot starts after this one.
std::uint64_t record_and_clear(const std::string& lttng_session_name);
// Has the programs tell of their objects again, for the snapshots that follow: each snapshot uses up a sub-buffer of
// each processor, so a few of them push the beginnings out. To be called when the snapshot is judged.
void have_objects_told_again(const std::string& lttng_session_name);

}  // namespace tracing
