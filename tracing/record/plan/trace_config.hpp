// SPDX-License-Identifier: Apache-2.0
// One trace, fully described: what `<trace>` and `launch trace` evaluate to.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/plan/ros_events.hpp"

namespace tracing {

// procname vpid vtid
const std::vector<std::string>& default_context_fields();

// The relay daemon of a live session without a url.
inline constexpr const char* kLocalRelayDaemon = "net://127.0.0.1";

// How a channel keeps its events. The defaults are those of the main userspace channel: they hold 200,000 events/s of
// 100 nodes on two busy processors (docs/trace_control.md), where the 2 x 32 KiB and 200 µs of ros2_tracing lose events
// and keep the reader polling.
struct ChannelBuffers {
  std::uint64_t subbuffer_size = 1 << 20;  // bytes, a power of two
  std::uint64_t subbuffer_count = 4;       // for each processor, a power of two
  std::uint32_t read_timer = 50'000;  // µs between two looks of the consumer into the buffers; 0: it is woken instead
  // µs that a traced thread waits for room in its buffers before an event is lost; 0: it never waits, -1: for ever.
  std::int64_t blocking_timeout = 0;
};

// A channel beside the default channel of each domain, for events that need buffers of their own.
struct ChannelConfig {
  std::string name;
  std::vector<std::string> events_ust;  // of one domain only
  std::vector<std::string> events_kernel;
  std::vector<std::string> syscalls;
  std::optional<std::vector<std::string>> context_fields = {};  // the fields of its domain unless given
  std::optional<std::uint64_t> subbuffer_size = {};             // this and the next four: as the domain's own channel
  std::optional<std::uint64_t> subbuffer_count = {};
  std::optional<std::uint32_t> read_timer = {};    // µs
  std::optional<std::uint32_t> switch_timer = {};  // µs
  std::optional<bool> overwrite = {};
  std::int64_t blocking_timeout = 0;  // as ChannelBuffers::blocking_timeout
};

// The owner of userspace buffers: a user, for all processes together, or each process.
enum class BufferOwner { kUser, kProcess };

// What a power cut takes at most, if the buffers are not full before: 5 s (docs/performance.md has the cost).
inline constexpr std::uint32_t kSwitchTimer = 5'000'000;  // µs

// The tracetools of a process that was built with another ROS 2.
struct TracetoolsUse {
  std::string process;  // the label of the launch
  bool is_own = false;  // ours stands in for theirs
  std::string theirs;   // the path of their library; "" if it is part of the program
  std::string version;  // of theirs; "" if it is unknown
  std::string reason;   // why theirs had to stay
};

// Events are given as the text of an event rule (event_rule.hpp), in the simplest case the name.
struct TraceConfig {
  std::string session_name;    // any time stamp already appended
  std::string part;            // folder of this machine below the directory of a trace of several machines; "": no part
  bool has_timestamp = false;  // a run may append a number (free_name.hpp)
  std::string base_path;       // absolute directory that will hold the trace directory
  bool append_trace = false;
  bool fail_on_loss = false;       // lost events are a failure of the run
  bool nothing_to_record = false;  // known when the session ends: no process ran that was to be recorded
  std::vector<std::string> events_ust = default_ros_events();
  std::vector<std::string> events_python;  // names of loggers
  std::vector<std::string> events_kernel;
  std::vector<std::string> syscalls;
  std::vector<std::string> context_fields_ust = default_context_fields();
  std::vector<std::string> context_fields_kernel = default_context_fields();
  ChannelBuffers ust;  // of the main userspace channel
  std::uint64_t subbuffer_size_kernel = 32 * 4096;
  bool init_channel = false;  // initialisation events in a channel of their own, `ros2_init`
  // µs after which a sub-buffer is written though it is not full; 0: never; unset: kSwitchTimer, never in a snapshot
  // session, which writes nothing by itself.
  std::optional<std::uint32_t> switch_timer_ust = {};
  std::optional<bool> overwrite_ust = {};  // lose the oldest events, not the newest; unset: in a snapshot session only
  BufferOwner buffers_ust = BufferOwner::kUser;
  std::uint64_t tracefile_size = 0;   // bytes after which a stream goes on in a further file; 0: one file
  std::uint64_t tracefile_count = 0;  // files of a stream that are kept, the oldest is overwritten; 0: all
  std::vector<ChannelConfig> channels;
  bool launch_events = false;    // those of provider `launch`, beside other userspace events
  std::string url;               // of a relay daemon, net://HOST[:CONTROL[:DATA]]; empty: recorded below base_path
  std::uint32_t live_timer = 0;  // µs between two deliveries to the viewers of a live session; 0: not a live session
  bool snapshot_mode = false;
  std::uint64_t snapshot_size = 0;              // largest size of a snapshot in bytes; 0: 10 userspace sub-buffers
  std::uint64_t snapshot_limit = 10;            // snapshots of a flight recorder that are kept
  std::vector<std::string> further_events_ust;  // recorded beside events_ust, in the same channel
  // Of one processor, for all traced processes together; above it classes of events are dropped in this order
  // (event_classes.hpp). 0: no limit.
  double max_overhead = 0;
  std::vector<std::string> drop_order;
  std::string event_counters;  // directory in which processes count their events (event_counters.hpp), or empty
  std::vector<TracetoolsUse> tracetools;  // known when the session ends
  bool dual_session = false;              // the snapshot half of a dual session: always a snapshot session
  bool dual_runtime = false;              // the runtime half of a dual session: never a snapshot session

  bool records_snapshots() const { return !dual_runtime && (snapshot_mode || dual_session); }
  std::uint32_t switch_timer() const { return switch_timer_ust.value_or(records_snapshots() ? 0 : kSwitchTimer); }
  // The trace goes to a relay daemon: there is no directory of ours to look into.
  bool over_network() const { return !url.empty() || live_timer != 0; }
  // Of the kernel's channel, for each processor.
  std::uint64_t subbuffer_count_kernel() const { return records_snapshots() ? 4 : 2; }

  // base_path/session_name, and the part below it; for the halves of a dual session …/snapshot and …/runtime below it.
  std::string trace_directory() const;
  // The entries of all channels.
  std::vector<std::string> all_events_ust() const;
  // Where the trace goes, for people: trace_directory(), or the relay daemon's address.
  std::string destination() const;

  // session_name; for the halves of a dual session session_name-snapshot and session_name-runtime.
  std::string lttng_session_name() const;
};

// `given` when not empty, else $ROS_TRACE_DIR, else $ROS_HOME/tracing, else ~/.ros/tracing; ~ expanded, made absolute
// (from the current directory: the session daemon has another one) and normalised.
std::string trace_base_path(const std::string& given, const std::map<std::string, std::string>& environment);

// "-YYYYMMDDHHMMSS", local time, now.
std::string session_timestamp();

}  // namespace tracing
