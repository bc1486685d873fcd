// SPDX-License-Identifier: Apache-2.0
// The results of the analysis of a trace, as plain data. All times are nanoseconds; points in time count from the epoch
// on the tracer's clock. A file in results/ has the structures of one subject. What their fields mean stands in the
// rows below each structure, from which the outputs are made (results/field.hpp).
#pragma once

#include "tracing/model/analysis/results/callbacks.hpp"
#include "tracing/model/analysis/results/chains.hpp"
#include "tracing/model/analysis/results/executors.hpp"
#include "tracing/model/analysis/results/launcher_events.hpp"
#include "tracing/model/analysis/results/lifecycle.hpp"
#include "tracing/model/analysis/results/overview.hpp"
#include "tracing/model/analysis/results/services.hpp"
#include "tracing/model/analysis/results/starts.hpp"
#include "tracing/model/analysis/results/topics.hpp"

namespace tracing {

struct Ros2Results {
  std::vector<CallbackResult> callbacks;    // those that ran at least once; by process, node, owner
  std::vector<TopicResult> topics;          // by name
  std::vector<CallResult> calls;            // by service, client, server
  std::vector<ActionResult> actions;        // by name, client
  std::vector<NodeResult> nodes;            // by process, name
  std::vector<ExecutionResult> executions;  // by process, kind; empty without events of `ros2_ext`
  std::uint64_t internal_messages = 0;      // published or taken by the middleware for itself
  std::uint64_t unknown_messages = 0;       // published or taken by objects whose initialisation is not in the trace
  std::uint64_t unknown_in_whole = 0;       // part of unknown_messages: of processes that began within the trace
  std::uint64_t unnamed_messages = 0;       // published without a publisher, by ros2_tracing before 8.0 (MessageCounts)
  std::uint64_t logs = 0;                   // on /rosout, by one of several nodes of a process (MessageCounts)
  std::vector<std::string> tracetools;      // the versions that processes have named in rcl_init, in order, once each
  bool is_older = false;                    // some of it was recorded by ros2_tracing before 8.0
  bool lacks_middleware = false;            // rcl_publish is in the trace, and no event of rmw that it leads to
  std::vector<std::string> remarks;         // sentences about what the version of ros2_tracing does not tell
  std::vector<SubscriptionResult> subscriptions;  // those with messages; by topic, node
  std::vector<ExecutorResult> executors;          // by process, thread
  std::vector<ChainResult> chains;                // those with names, then from the slowest; those with few inputs last
  std::vector<std::string> unseen_chains;         // names of chains that never were gone through
  bool has_all_chains = true;                     // false: there were too many
  std::vector<LifecycleResult> lifecycle;         // by node, begin
  std::vector<UnmatchedResult> unmatched;
  bool lacks_thread_context = false;  // events without vpid or vtid: processes and threads can't be told apart
};

struct TraceResults {
  TraceOverview overview;
  std::vector<StartResult> starts;                   // in the order of the launcher's events; empty without these
  std::optional<StartupResult> startup;              // nullopt: no process of the launcher was ready in the trace
  std::vector<LauncherEventResult> launcher_events;  // by time; empty without the launcher's events
  Ros2Results ros2;
  std::vector<std::string> warnings;  // about events that are not as ros2_tracing records them
};

}  // namespace tracing
