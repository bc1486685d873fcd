// SPDX-License-Identifier: Apache-2.0
// The results of the analysis of a trace, as plain data. All times are nanoseconds; points in time count from the epoch
// on the tracer's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/analysis/duration_statistics.hpp"

namespace tracing {

struct ProcessResult {
  std::optional<std::int64_t> vpid;  // nullopt: all events that were recorded without the context vpid
  std::string name;                  // procname of its main thread, else of the first thread seen; may be empty
  std::uint64_t events = 0;
  bool doubtful = false;  // events may be missing, because a buffer that it may have used lost some
};

struct EventCount {
  std::string name;
  std::uint64_t total = 0;
  std::vector<std::uint64_t> by_process;  // one for each process, in the order of the processes
};

// The losses of one stream (one buffer).
struct LossResult {
  std::string stream;                    // path of the stream file
  std::uint64_t events = 0;              // dropped events, as far as they were counted
  std::uint64_t packets = 0;             // overwritten before they were written out
  bool uncounted = false;                // more were lost, but their number is unknown
  std::optional<std::int64_t> begin_ns;  // all losses lie within this range, if the trace tells
  std::optional<std::int64_t> end_ns;
  std::vector<std::size_t> processes;  // indices of the processes that may have lost events here
};

struct TraceOverview {
  std::uint64_t events = 0;
  std::optional<std::int64_t> begin_ns;  // first event, nullopt when there is none
  std::optional<std::int64_t> end_ns;    // last event
  std::vector<ProcessResult> processes;  // by vpid
  std::vector<EventCount> event_counts;  // by name
  std::vector<LossResult> losses;        // by stream; empty: nothing was lost

  std::uint64_t lost_events() const;
  std::uint64_t lost_packets() const;
  bool lost_uncounted() const;
};

struct CallbackResult {
  enum class Owner { kUnknown, kSubscription, kTimer, kService, kClient };
  std::int64_t vpid = 0;
  std::string node;  // fully qualified; empty when the trace doesn't tell
  Owner owner = Owner::kUnknown;
  std::string owner_name;      // topic or service, for a client the service that it asks; empty for timers
  std::int64_t period_ns = 0;  // of a timer
  std::uint64_t address = 0;
  std::string symbol;               // readable; empty when the trace doesn't tell
  DurationSummary durations;        // of the instances that have a start and an end
  std::uint64_t intra_process = 0;  // how many of these got their message without the middleware
  std::uint64_t unfinished = 0;     // started, but without an end: an exception, a killed process, or still running
};

struct TopicResult {
  std::string name;
  std::uint32_t publishers = 0;  // objects in the trace
  std::uint32_t subscriptions = 0;
  std::uint64_t published = 0;       // messages handed to the middleware
  std::uint64_t received = 0;        // messages taken; each subscription counts its own
  std::uint64_t published_only = 0;  // part of published: no subscription in the trace took the message
  std::uint64_t received_only = 0;   // part of received: the publication is not in the trace
  DurationSummary latency;           // event rmw_publish to event callback_start, of messages with both
};

// The calls of one client to one service.
struct CallResult {
  std::string service;                      // its name
  std::optional<std::int64_t> client_vpid;  // nullopt: the client is not in the trace
  std::string client;                       // its node; empty when the trace doesn't tell
  std::optional<std::int64_t> server_vpid;  // nullopt: the service is not in the trace, or never took a request
  std::string server;                       // its node
  std::uint64_t requests = 0;
  std::uint64_t responses = 0;  // fewer than requests: some were not answered within the trace
  DurationSummary round_trip;   // rmw_send_request to rmw_take_response
  DurationSummary request;      // rmw_send_request to rmw_take_request
  DurationSummary in_service;   // rmw_take_request to rmw_send_response
  DurationSummary response;     // rmw_send_response to rmw_take_response
};

// Executions for which ROS 2 has no event but rclcpp_executor_execute.
struct ExecutionResult {
  enum class Kind { kService, kClient, kWaitable };
  std::int64_t vpid = 0;
  Kind kind = Kind::kService;
  std::string node;           // empty for waitables, and when the trace doesn't tell
  std::string service;        // likewise
  std::uint64_t address = 0;  // of a waitable, and of an object that has no name in the trace
  std::uint64_t count = 0;
  DurationSummary durations;  // to the response of a service or the end of a client's callback; none for waitables
};

struct Ros2Results {
  std::vector<CallbackResult> callbacks;    // those that ran at least once; by process, node, owner
  std::vector<TopicResult> topics;          // by name
  std::vector<CallResult> calls;            // by service, client, server
  std::vector<ExecutionResult> executions;  // by process, kind; empty without events of `ros2_ext`
  std::uint64_t internal_messages = 0;      // published or taken by the middleware for itself
  std::uint64_t unknown_messages = 0;       // published or taken by objects whose initialisation is not in the trace
  bool lacks_thread_context = false;        // events without vpid or vtid: processes and threads can't be told apart
};

// A process that the launcher started.
struct StartResult {
  std::int64_t vpid = 0;
  std::string process;  // the launcher's name for it: "talker-1"
  std::string file;     // the place in the launch file that asked for it
  std::int64_t line = 0;
  std::int64_t exec_ns = 0;                    // when its program began to run
  std::optional<std::int64_t> node_after_ns;   // from exec_ns to its first node; nullopt: none, or not in the trace
  std::optional<std::int64_t> ready_after_ns;  // from exec_ns to the first event of an executor after that
};

struct TraceResults {
  TraceOverview overview;
  std::vector<StartResult> starts;  // in the order of the launcher's events; empty without these
  Ros2Results ros2;
  std::vector<std::string> warnings;  // about events that are not as ros2_tracing records them
};

}  // namespace tracing
