// What an analysis of a trace found, as plain data. All times are nanoseconds; points in time are since the epoch on
// the tracer's clock.
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
  bool doubtful = false;  // events may be missing, because a buffer it may have used lost some
};

struct EventCount {
  std::string name;
  std::uint64_t total = 0;
  std::vector<std::uint64_t> by_process;  // as many as there are processes, in their order
};

// What one stream (one buffer) lost.
struct LossResult {
  std::string stream;                    // path of the stream file
  std::uint64_t events = 0;              // dropped, as far as they were counted
  std::uint64_t packets = 0;             // overwritten before they were written out
  bool uncounted = false;                // some more, of unknown number
  std::optional<std::int64_t> begin_ns;  // all of it lies within this range, if the trace tells
  std::optional<std::int64_t> end_ns;
  std::vector<std::size_t> processes;  // indices of those that may have lost events here
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
  enum class Owner { kUnknown, kSubscription, kTimer, kService };
  std::int64_t vpid = 0;
  std::string node;  // fully qualified; empty when the trace doesn't tell
  Owner owner = Owner::kUnknown;
  std::string owner_name;      // topic or service; empty for timers
  std::int64_t period_ns = 0;  // of a timer
  std::uint64_t address = 0;
  std::string symbol;               // readable; empty when the trace doesn't tell
  DurationSummary durations;        // of the instances that have a start and an end
  std::uint64_t intra_process = 0;  // of those: how many got their message without the middleware
  std::uint64_t unfinished = 0;     // started, but no end: an exception, a killed process, or still running
};

struct TopicResult {
  std::string name;
  std::uint32_t publishers = 0;  // objects in the trace
  std::uint32_t subscriptions = 0;
  std::uint64_t published = 0;       // messages handed to the middleware
  std::uint64_t received = 0;        // messages taken; each subscription counts its own
  std::uint64_t published_only = 0;  // of published: no subscription in the trace took it
  std::uint64_t received_only = 0;   // of received: the publication is not in the trace
  DurationSummary latency;           // event rmw_publish to event callback_start, of messages with both
};

struct Ros2Results {
  std::vector<CallbackResult> callbacks;  // that ran at least once; by process, node, owner
  std::vector<TopicResult> topics;        // by name
  std::uint64_t internal_messages = 0;    // published or taken by the middleware for itself
  std::uint64_t unknown_messages = 0;     // published or taken by objects whose initialisation is not in the trace
  bool lacks_thread_context = false;      // events without vpid or vtid: processes and threads can't be told apart
};

struct TraceResults {
  TraceOverview overview;
  Ros2Results ros2;
  std::vector<std::string> warnings;  // about events that are not as ros2_tracing records them
};

}  // namespace tracing
