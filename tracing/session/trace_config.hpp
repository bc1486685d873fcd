// One trace, fully described: what `<trace>` and `launch trace` evaluate to.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tracing {

// The 42 events of provider `ros2`, and those that describe objects once (initialisation events).
const std::vector<std::string>& default_ros_events();  // "ros2:rcl_init", …
const std::vector<std::string>& initialisation_ros_events();
// procname vpid vtid
const std::vector<std::string>& default_context_fields();

struct TraceConfig {
  std::string session_name;  // final: any time stamp already appended
  std::string base_path;     // absolute directory that will hold the trace directory
  bool append_trace = false;
  bool fail_on_loss = false;  // lost events are a failure of the run
  std::vector<std::string> events_ust = default_ros_events();
  std::vector<std::string> events_kernel;
  std::vector<std::string> syscalls;
  std::vector<std::string> context_fields_ust = default_context_fields();
  std::vector<std::string> context_fields_kernel = default_context_fields();
  std::uint64_t subbuffer_size_ust = 8 * 4096;  // bytes, rounded up to a power of two
  std::uint64_t subbuffer_size_kernel = 32 * 4096;
  bool init_channel = false;              // initialisation events in a channel of their own, `ros2_init`
  std::uint64_t subbuffer_count_ust = 0;  // for each processor, a power of two; 0: 2, and 4 in a snapshot session
  std::uint32_t read_timer_ust = 200;  // µs between two looks of the consumer into the buffers; 0: it is woken instead
  std::uint32_t switch_timer_ust = 0;  // µs after which a sub-buffer is written though it is not full; 0: never
  bool snapshot_mode = false;
  bool dual_session = false;  // the snapshot half of a dual session: always a snapshot session
  bool dual_runtime = false;  // the runtime half of a dual session: never a snapshot session

  bool records_snapshots() const { return !dual_runtime && (snapshot_mode || dual_session); }
  // Sub-buffers for each processor, where none are asked for.
  std::uint64_t default_subbuffer_count() const { return records_snapshots() ? 4 : 2; }

  // base_path/session_name; for the halves of a dual session …/snapshot and …/runtime below it.
  std::string trace_directory() const;
  // session_name; for the halves of a dual session session_name-snapshot and session_name-runtime.
  std::string lttng_session_name() const;
};

// `given` when not empty, else $ROS_TRACE_DIR, else $ROS_HOME/tracing, else ~/.ros/tracing; ~ expanded, made absolute
// (from the current directory: the session daemon has another one) and normalised.
std::string trace_base_path(const std::string& given, const std::map<std::string, std::string>& environment);

// "-YYYYMMDDHHMMSS", local time, now.
std::string session_timestamp();

}  // namespace tracing
