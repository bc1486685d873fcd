// SPDX-License-Identifier: Apache-2.0
// What ran when in a trace, as plain data: objects, and every instance of a callback, message, lifecycle state and
// state of a thread.
//
// Objects refer to one another by their index. Times are nanoseconds since the epoch on the tracer's clock. The memory
// grows with the number of instances, messages and states, 32 to 64 bytes for each. `Details` is empty unless it was
// asked for; it has 24 to 48 bytes for each of what it lists.
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
  std::uint64_t queue_depth = 0;
  std::optional<ros2::EndpointQos> qos = std::nullopt;
};

// What the publisher sends is also caused by the last message that the subscription got: user code has declared it.
struct KeptMessage {
  Index publisher = kNone;
  Index subscription = kNone;
};

struct Timer {
  Index node = kNone;
  std::int64_t period_ns = 0;
};

struct ServiceEnd {  // service or client
  Index node = kNone;
  std::string name;  // of the service
};

// An executor and its callback groups are known from the events of CARET alone.
struct Executor {
  Index process = kNone;
  std::uint64_t address = 0;
  std::string kind;  // single_threaded_executor, …; empty when the trace does not tell
};

struct CallbackGroup {
  Index executor = kNone;
  std::string kind;  // mutually_exclusive, reentrant; likewise
};

// The time of nodes with use_sim_time, likewise.
struct SimulatedTime {
  std::int64_t time_ns = 0;
  std::int64_t simulated_ns = 0;
};

struct Callback {
  Index process = kNone;
  Index node = kNone;
  Index group = kNone;
  CallbackResult::Owner owner = CallbackResult::Owner::kUnknown;
  Index owner_id = kNone;      // in the list of its kind: subscriptions, timers, services, clients
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
  std::int64_t callback_ns = 0;   // begin of the callback that got it, which the trace may end before; 0: none
  Index topic = kNone;
  Index publisher = kNone;  // index in publishers
  Index publishing_thread = kNone;
  Index publishing_instance = kNone;  // the instance that has published it; kNone: outside of callbacks
  Index subscription = kNone;         // index in subscriptions
  Index taking_thread = kNone;
  Index receiving_instance = kNone;  // the instance that got it
  bool repeated = false;             // an earlier message is the same publication, taken by another subscription
  // dds:write, after published_ns; 0: not in the trace, or later than this type can tell (8 ms). It takes the place of
  // padding, as does what follows.
  std::uint32_t written_after_ns : 23 = 0;
  std::uint32_t needs_no_callback : 1 = 0;  // MessageFlow::needs_no_callback
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

// What Message has no place for.
struct MessageDetail {
  std::int64_t rcl_ns = 0;  // rcl_publish, dds:write; 0: not in the trace
  std::int64_t written_ns = 0;
  std::int64_t waited_ns = -1;  // MessageFlow::executor_waited_ns; -1: not known
  bool has_rclcpp = false;      // Message::called_ns is rclcpp_publish
  bool intra_process = false;
  bool is_estimated = false;  // MessageFlow::is_estimated
};

// A request to a service; 0 for what the trace does not hold.
struct Call {
  Index client = kNone;
  Index service = kNone;
  std::int64_t sent_ns = 0;
  std::int64_t taken_ns = 0;
  std::int64_t answered_ns = 0;
  std::int64_t received_ns = 0;

  std::int64_t begin_ns() const { return sent_ns != 0 ? sent_ns : taken_ns != 0 ? taken_ns : received_ns; }
};

struct Wait {  // of an executor, for work
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  Index thread = kNone;
};

// What a callback asked the C library for.
struct InstanceMemory {
  Index instance = kNone;
  std::uint64_t calls = 0;
  std::uint64_t bytes = 0;
};

struct ChainHop {
  std::uint32_t before = kNone;  // index in hops; kNone: the chain begins here
  Index instance = kNone;
};

struct ChainPassage {
  std::uint32_t path = 0;  // ChainResult::path
  std::uint32_t last_hop = kNone;
  std::int64_t input_ns = 0;
  std::int64_t output_ns = 0;
  bool is_first = false;
};

struct Details {
  std::vector<MessageDetail> messages;  // as Timeline::messages
  std::vector<Call> calls;              // by begin
  std::vector<Wait> waits;              // by begin
  std::vector<InstanceMemory> memory;   // by instance; those that asked for none are left out
  std::vector<ChainHop> hops;
  std::vector<ChainPassage> passages;  // by output
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
  std::vector<KeptMessage> kept;
  std::vector<Timer> timers;
  std::vector<ServiceEnd> services;
  std::vector<ServiceEnd> clients;
  std::vector<Executor> executors;
  std::vector<CallbackGroup> callback_groups;
  std::vector<SimulatedTime> simulated_times;  // by time
  std::vector<Callback> callbacks;
  std::vector<Instance> instances;        // by start
  std::vector<Message> messages;          // by time of publication
  std::vector<LifecycleState> lifecycle;  // by node, then time
  std::vector<ThreadState> states;        // by begin; empty without events of the kernel's scheduler
  std::vector<OtherThread> other_threads;
  Details details;
};

}  // namespace tracing::timeline
