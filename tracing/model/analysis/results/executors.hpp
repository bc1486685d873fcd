// SPDX-License-Identifier: Apache-2.0
// The threads and nodes that run callbacks, and what executors serve beside them.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

// One thread that runs callbacks.
struct ExecutorResult {
  ProcessIndex process = 0;
  std::int64_t vtid = 0;
  std::int64_t span_ns = 0;
  std::uint64_t callbacks = 0;
  std::int64_t callback_ns = 0;
  std::optional<std::int64_t> waited_ns;
  double utilisation = 0;
  std::int64_t longest_busy_ns = 0;
  std::int64_t longest_busy_begin_ns = 0;
  std::string longest_callback;
  bool doubtful = false;

  static const Field<ExecutorResult> kFields[];
};
inline constexpr Field<ExecutorResult> ExecutorResult::kFields[] = {
    {"process", &ExecutorResult::process, "index in `processes`", trait::kProcess},
    {"vtid", &ExecutorResult::vtid, ""},
    {"span_ns", &ExecutorResult::span_ns, "how long the trace tells of the thread"},
    {"callbacks", &ExecutorResult::callbacks, "that it ran"},
    {"callback_ns", &ExecutorResult::callback_ns, "time in callbacks"},
    {"waited_ns", &ExecutorResult::waited_ns, "for work; `null` if the executor records no waits"},
    {"utilisation", &ExecutorResult::utilisation, "the part of the span without waiting, or in callbacks; 0 to 1"},
    {"longest_busy_ns", &ExecutorResult::longest_busy_ns, "the longest time without a look for work; 0: not known"},
    {"longest_busy_begin_ns", &ExecutorResult::longest_busy_begin_ns, "when that began", trait::kTime},
    {"longest_callback", &ExecutorResult::longest_callback, "of all in that time: `/node, timer 100 ms`"},
    {"doubtful", &ExecutorResult::doubtful, "its process may have lost events"},
};

// A node, and what its callbacks took together. Several nodes of one process are components.
struct NodeResult {
  ProcessIndex process = 0;
  std::string name;
  std::uint64_t callbacks = 0;
  std::int64_t callback_ns = 0;

  static const Field<NodeResult> kFields[];
};
inline constexpr Field<NodeResult> NodeResult::kFields[] = {
    {"process", &NodeResult::process, "index in `processes`; several nodes of one process are components",
     trait::kProcess},
    {"name", &NodeResult::name, "with its namespace"},
    {"callbacks", &NodeResult::callbacks, "runs of its callbacks"},
    {"callback_ns", &NodeResult::callback_ns, "time in them"},
};

// Executions for which ROS 2 has no event but rclcpp_executor_execute.
struct ExecutionResult {
  enum class Kind { kService, kClient, kWaitable };
  ProcessIndex process = 0;
  Kind kind = Kind::kService;
  std::string node;
  std::string service;
  std::uint64_t address = 0;  // of a waitable, and of an object that has no name in the trace
  std::uint64_t count = 0;
  DurationSummary durations;

  const char* kind_word() const;
  bool is_waitable() const { return kind == Kind::kWaitable; }
  bool is_of_service() const { return kind != Kind::kWaitable; }

  static const Field<ExecutionResult> kFields[];
};

// In the order of ExecutionResult::Kind.
inline constexpr const char* kExecutionKinds[] = {"service", "client", "waitable"};

inline const char* ExecutionResult::kind_word() const {
  return kExecutionKinds[static_cast<std::size_t>(kind)];
}

inline constexpr Field<ExecutionResult> ExecutionResult::kFields[] = {
    {"process", &ExecutionResult::process, "index in `processes`", trait::kProcess},
    {"node", &ExecutionResult::node, "none for waitables"},
    {"kind", {&ExecutionResult::kind_word, kExecutionKinds}, "what was served"},
    {"service", &ExecutionResult::service, "of a service or client", trait::kPlain, &ExecutionResult::is_of_service},
    {"address", &ExecutionResult::address, "of a waitable", trait::kPlain, &ExecutionResult::is_waitable},
    {"count", &ExecutionResult::count, ""},
    {"duration", &ExecutionResult::durations,
     "until the response was sent or the client's callback had ended; waitables have none"},
};

}  // namespace tracing
