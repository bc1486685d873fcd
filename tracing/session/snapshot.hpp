// The output of snapshot sessions, and recording one.
#pragma once

#include <string>

#include "tracing/session/trace_config.hpp"

namespace tracing {

// What the directories of snapshots begin with.
inline constexpr const char* kSnapshotName = "snapshot";

// Where the snapshots of `config`'s session go. Each makes a directory of its own below the trace directory.
void add_snapshot_output(const TraceConfig& config);

// Writes what the buffers of the session hold.
void record_snapshot(const std::string& lttng_session_name);
// The same, then empties them, so that the next snapshot starts after this one.
void record_and_clear(const std::string& lttng_session_name);

}  // namespace tracing
