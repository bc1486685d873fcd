// SPDX-License-Identifier: Apache-2.0
// The results of the analysis of a trace, as plain data. All times are nanoseconds; points in time count from the epoch
// on the tracer's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"

namespace tracing {

struct ProcessResult {
  std::optional<std::int64_t> vpid;  // nullopt: all events that were recorded without the context vpid
  std::string name;                  // procname of its main thread, else of the first thread seen; may be empty
  std::uint64_t events = 0;
  bool doubtful = false;  // events may be missing, because a buffer that it may have used lost some
  std::string host;       // the name of its machine; empty when the trace does not tell
};

// The place of a process in TraceOverview::processes.
using ProcessIndex = std::size_t;

struct EventCount {
  std::string name;
  std::uint64_t total = 0;                // for an event of the launcher, which is none of the processes, all of it
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
  std::vector<ProcessResult> processes;  // by host and vpid
  std::vector<EventCount> event_counts;  // by name
  std::vector<LossResult> losses;        // by stream; empty: nothing was lost

  std::uint64_t lost_events() const;
  std::uint64_t lost_packets() const;
  bool lost_uncounted() const;
};

struct CallbackResult {
  enum class Owner { kUnknown, kSubscription, kTimer, kService, kClient };
  std::uint32_t id = 0;  // ObjectId: index in ObjectModel::callbacks()
  ProcessIndex process = 0;
  std::string node;  // fully qualified; empty when the trace doesn't tell
  Owner owner = Owner::kUnknown;
  std::string owner_name;      // topic or service, for a client the service that it asks; empty for timers
  std::int64_t period_ns = 0;  // of a timer
  std::uint64_t address = 0;
  std::string symbol;               // readable; empty when the trace doesn't tell
  DurationSummary durations;        // of the instances that have a start and an end
  std::uint64_t intra_process = 0;  // how many of these got their message without the middleware
  std::uint64_t unfinished = 0;     // started, but without an end: an exception, a killed process, or still running
  double rate_hz = 0;               // begins in a second, between the first and the last one; 0 for a single one
  DurationSummary interval;         // from one begin to the next
  DurationSummary jitter;           // of a timer: how far the intervals are from its period
  std::uint64_t missed = 0;         // of a timer: periods without a call
  std::uint64_t overruns = 0;       // of a timer: runs that took longer than its period
  std::optional<std::uint64_t> allocations;  // calls of malloc and the like; nullopt when these are not in the trace
  std::uint64_t allocated_bytes = 0;
  // Of the instances whose thread is in events of the kernel's scheduler: parts of their durations.
  DurationSummary running;
  DurationSummary runnable;  // waited for a processor
  DurationSummary blocked;
  std::int64_t longest_runnable_ns = 0;  // without a break
  std::string ran_instead;               // the thread that had the processor last in that time
  bool doubtful = false;                 // events of its process may be missing
};

struct TopicResult {
  std::string name;
  std::uint32_t publishers = 0;  // objects in the trace
  std::uint32_t subscriptions = 0;
  std::uint64_t published = 0;                // messages handed to the middleware
  std::uint64_t received = 0;                 // messages taken; each subscription counts its own
  std::uint64_t published_only = 0;           // part of published: no subscription in the trace took the message
  std::uint64_t received_only = 0;            // part of received: the publication is not in the trace
  DurationSummary latency;                    // event rmw_publish to event callback_start, of messages with both
  double rate_hz = 0;                         // messages in a second, of all publishers, within the process or not
  DurationSummary interval;                   // from one message of a publisher to its next one
  std::uint64_t intra_process_published = 0;  // handed to subscriptions of the publisher's process
  std::uint64_t intra_process_received = 0;
  std::uint64_t early = 0;       // part of received, without a latency: taken before they were published
  std::int64_t earliest_ns = 0;  // how long before, at most: the clocks of two machines differ
  // Events of a publisher's or a subscription's process may be missing, or clocks differ.
  bool doubtful = false;
};

// What became of the messages for one subscription. The parts of the latency are explained in delivery_statistics.hpp.
struct SubscriptionResult {
  ProcessIndex process = 0;
  std::string node;
  std::string topic;
  std::uint64_t queue_depth = 0;
  std::uint64_t received = 0;
  std::uint64_t intra_process = 0;  // part of received
  std::uint64_t delivered = 0;
  std::uint64_t not_executed = 0;
  std::uint64_t overwritten = 0;
  std::uint64_t overwritten_in_buffer = 0;  // within the process
  std::uint64_t lost = 0;
  std::uint64_t lost_by_publisher = 0;  // part of lost: pushed out of the publisher's queue
  std::uint64_t lost_in_transport = 0;  // part of lost
  std::uint64_t before_first = 0;
  std::uint64_t after_last = 0;
  DurationSummary latency;
  DurationSummary rclcpp;
  DurationSummary rcl;
  DurationSummary transport;
  DurationSummary executor;
  DurationSummary take;
  bool doubtful = false;

  std::uint64_t lost_unplaced() const { return lost - lost_by_publisher - lost_in_transport; }
  std::uint64_t dropped() const { return not_executed + overwritten + overwritten_in_buffer + lost; }
};

// One thread that runs callbacks.
struct ExecutorResult {
  ProcessIndex process = 0;
  std::int64_t vtid = 0;
  std::int64_t span_ns = 0;  // how long the trace tells of it
  std::uint64_t callbacks = 0;
  std::int64_t callback_ns = 0;           // in callbacks
  std::optional<std::int64_t> waited_ns;  // for work; nullopt when the executor does not record it
  double utilisation = 0;                 // the part of the span without waiting, or in callbacks; 0 to 1
  std::int64_t longest_busy_ns = 0;       // the longest time without a look for work; 0: not known
  std::int64_t longest_busy_begin_ns = 0;
  std::string longest_callback;  // of all in that time: "/node, timer 100 ms"
  bool doubtful = false;
};

// Callbacks that cause one another by messages. The times are explained in chain_tracker.hpp.
struct ChainResult {
  struct Step {
    ProcessIndex process = 0;
    std::string node;
    std::string callback;           // what calls it: "timer 100 ms", "subscription /ping"
    std::uint32_t callback_id = 0;  // as CallbackResult::id
    std::string topic;              // that led here; empty at the begin
    DurationSummary until_publish;  // from the begin of the callback before to its publication
    DurationSummary transfer;       // from there to the begin of this callback, of which are
    DurationSummary executor;       // the wait for the executor; count 0 when the trace does not tell
    DurationSummary take;           // from rmw_take to the begin of this callback
  };
  std::vector<Step> steps;
  std::string name;                       // given by the user; empty: the chain was found
  std::optional<std::int64_t> budget_ns;  // for the response
  std::uint64_t over_budget = 0;          // responses that took longer
  DurationSummary last_callback;          // from the begin to the end of the last callback
  DurationSummary response;
  DurationSummary reaction;
  DurationSummary age;
  std::int64_t longest_begin_ns = 0;  // of the longest response
  std::int64_t longest_end_ns = 0;
  bool is_loop = false;  // the last callback is part of the chain already
  bool doubtful = false;
};

struct LifecycleResult {
  ProcessIndex process = 0;
  std::string node;
  std::string state;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool ended = true;  // false: the trace ended before the state
  // Calls of malloc and the like in the callbacks of the node, and in its whole process, of which other nodes may be
  // part; nullopt when these are not in the trace.
  std::optional<std::uint64_t> allocations = {};
  std::uint64_t allocated_bytes = 0;
  std::uint64_t process_allocations = 0;
  std::uint64_t process_allocated_bytes = 0;
};

// Events without the other event that belongs to them.
struct UnmatchedResult {
  std::string event;
  std::string reason;
  std::uint64_t count = 0;
};

// The calls of one client to one service.
struct CallResult {
  std::string service;                         // its name
  std::optional<ProcessIndex> client_process;  // nullopt: the client is not in the trace
  std::string client;                          // its node; empty when the trace doesn't tell
  std::optional<ProcessIndex> server_process;  // nullopt: the service is not in the trace, or never took a request
  std::string server;                          // its node
  std::uint64_t requests = 0;
  std::uint64_t responses = 0;  // fewer than requests: some were not answered within the trace
  DurationSummary round_trip;   // rmw_send_request to rmw_take_response
  DurationSummary request;      // rmw_send_request to rmw_take_request
  DurationSummary in_service;   // rmw_take_request to rmw_send_response
  DurationSummary response;     // rmw_send_response to rmw_take_response
};

// What one client asks of one action.
struct ActionResult {
  std::string name;
  std::optional<ProcessIndex> client_process;  // as in CallResult
  std::string client;
  std::optional<ProcessIndex> server_process;
  std::string server;
  std::uint64_t goals = 0;     // sent
  std::uint64_t answers = 0;   // whether they are accepted
  std::uint64_t results = 0;   // received
  std::uint64_t cancels = 0;   // asked for
  std::uint64_t feedback = 0;  // messages that the server published, for all clients
  DurationSummary acceptance;  // from a goal to the answer
  DurationSummary execution;   // from the request for a result to the result
};

// A node, and what its callbacks took together. Several nodes of one process are components.
struct NodeResult {
  ProcessIndex process = 0;
  std::string name;  // fully qualified
  std::uint64_t callbacks = 0;
  std::int64_t callback_ns = 0;
};

// Executions for which ROS 2 has no event but rclcpp_executor_execute.
struct ExecutionResult {
  enum class Kind { kService, kClient, kWaitable };
  ProcessIndex process = 0;
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
  std::vector<ActionResult> actions;        // by name, client
  std::vector<NodeResult> nodes;            // by process, name
  std::vector<ExecutionResult> executions;  // by process, kind; empty without events of `ros2_ext`
  std::uint64_t internal_messages = 0;      // published or taken by the middleware for itself
  std::uint64_t unknown_messages = 0;       // published or taken by objects whose initialisation is not in the trace
  std::vector<SubscriptionResult> subscriptions;  // those with messages; by topic, node
  std::vector<ExecutorResult> executors;          // by process, thread
  std::vector<ChainResult> chains;                // those with names, then from the slowest; those with few inputs last
  std::vector<std::string> unseen_chains;         // names of chains that never were gone through
  bool has_all_chains = true;                     // false: there were too many
  std::vector<LifecycleResult> lifecycle;         // by node, begin
  std::vector<UnmatchedResult> unmatched;
  bool lacks_thread_context = false;  // events without vpid or vtid: processes and threads can't be told apart
};

// A process that the launcher started. Times count from exec_ns; nullopt: it did not happen, or is not in the trace.
struct StartResult {
  std::int64_t vpid = 0;
  std::string process;  // the launcher's name for it: "talker-1"
  std::string file;     // the place in the launch file that asked for it
  std::int64_t line = 0;
  std::int64_t exec_ns = 0;                        // when its program began to run
  std::optional<std::int64_t> node_after_ns;       // its first node
  std::optional<std::int64_t> ready_after_ns;      // the first event of an executor after that
  std::optional<ProcessIndex> place = {};          // nullopt: it recorded nothing
  std::optional<std::int64_t> spawn_ns = {};       // when the launcher began to start it, before exec_ns
  std::optional<std::int64_t> init_after_ns = {};  // rcl_init
  std::optional<std::int64_t> callback_after_ns = {};
  std::optional<std::int64_t> publication_after_ns = {};  // on any topic but /rosout and /parameter_events
};

// A part of the way from the begin of the launch until every process was ready.
struct StartStep {
  std::string process;  // "talker-1"; empty: the launcher itself
  std::string what;     // "load a.launch.xml", "until rcl_init"
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

// The steps that the process which was ready last had to wait for, in the order of time and without gaps. Had one of
// them taken less time, the system would have been ready earlier.
struct StartupResult {
  std::int64_t begin_ns = 0;  // of the first step of the launcher
  std::int64_t ready_ns = 0;  // the last process was ready
  std::vector<StartStep> critical_path;
};

struct TraceResults {
  TraceOverview overview;
  std::vector<StartResult> starts;       // in the order of the launcher's events; empty without these
  std::optional<StartupResult> startup;  // nullopt: no process of the launcher was ready in the trace
  Ros2Results ros2;
  std::vector<std::string> warnings;  // about events that are not as ros2_tracing records them
};

}  // namespace tracing
