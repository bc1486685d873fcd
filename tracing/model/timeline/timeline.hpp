// SPDX-License-Identifier: Apache-2.0
// What ran when in a trace, as plain data: objects, and every instance of a callback, message, lifecycle state and
// state of a thread.
//
// Objects refer to one another by their index. Times are nanoseconds since the epoch on the tracer's clock. The memory
// grows with the number of instances, messages and states, 32 to 64 bytes for each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/execution_sink.hpp"

namespace tracing::timeline {

using Index = std::uint32_t;
inline constexpr Index kNone = 0xffffffff;

struct Process {
  std::int64_t vpid = 0;  // 0 when the trace does not hold it
  std::string name;
  std::string host;                   // empty when the trace does not tell
  std::optional<ProcessIndex> place;  // in TraceOverview::processes
};

struct Thread {  // that ran a callback or published
  Index process = kNone;
  std::int64_t vtid = 0;
};

struct Node {
  Index process = kNone;
  std::string name;  // fully qualified
};

struct Endpoint {  // publisher or subscription
  Index node = kNone;
  Index topic = kNone;
};

struct Callback {
  Index process = kNone;
  Index node = kNone;
  CallbackResult::Owner owner = CallbackResult::Owner::kUnknown;
  Index topic = kNone;         // of a subscription
  std::string service;         // of a service or client
  std::int64_t period_ns = 0;  // of a timer
  std::uint64_t address = 0;
  std::string symbol;  // readable
};

// One run of a callback.
struct Instance {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;  // of an unfinished instance: the latest time at which it may have ended
  Index callback = kNone;
  Index thread = kNone;
  Index message = kNone;  // that it got
  bool finished = false;
  bool intra_process = false;
};

// One message on its way to one subscription. A message that several subscriptions take is there several times.
struct Message {
  std::int64_t called_ns = 0;     // the call of publish: rclcpp_publish, else rcl_publish, else published_ns
  std::int64_t published_ns = 0;  // rmw_publish, or rclcpp_intra_publish
  std::int64_t taken_ns = 0;      // rmw_take, or the dequeue within the process; 0: nobody in the trace has taken it
  Index topic = kNone;
  Index publisher = kNone;  // index in publishers
  Index publishing_thread = kNone;
  Index publishing_instance = kNone;  // the instance that has published it; kNone: outside of callbacks
  Index subscription = kNone;         // index in subscriptions
  Index taking_thread = kNone;
  Index receiving_instance = kNone;  // the instance that got it
  bool repeated = false;             // an earlier message is the same publication, taken by another subscription
};

struct LifecycleState {
  Index node = kNone;
  std::string state;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;  // of the last state: the end of the trace
};

// What a thread did on the machine, as the kernel's scheduler tells it.
struct ThreadState {
  using State = ThreadInterval::State;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  Index thread = kNone;
  Index other = kNone;  // index in other_threads: runnable, which thread had the processor longest; kNone: none
  std::int32_t cpu = 0;
  State state = State::kRunning;
};

// A thread of the machine that had a processor for which a thread of the timeline waited.
struct OtherThread {
  std::int64_t tid = 0;  // as the kernel numbers it
  std::string name;
};

struct Timeline {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  std::vector<Process> processes;
  std::vector<Thread> threads;
  std::vector<Node> nodes;
  std::vector<std::string> topics;
  std::vector<Endpoint> publishers;
  std::vector<Endpoint> subscriptions;
  std::vector<Callback> callbacks;
  std::vector<Instance> instances;        // by start
  std::vector<Message> messages;          // by time of publication
  std::vector<LifecycleState> lifecycle;  // by node, then time
  std::vector<ThreadState> states;        // by begin; empty without events of the kernel's scheduler
  std::vector<OtherThread> other_threads;
};

}  // namespace tracing::timeline
