// SPDX-License-Identifier: Apache-2.0
// What a traced system did, one thing after another, told while the trace is read.
//
//   class TimeChart : public ExecutionSink { void on_callback(const CallbackInstance& instance) override { … } };
//   TimeChart chart;
//   TraceAnalysis analysis(&chart);
//   TraceReader(directory).read(analysis);
//   analysis.finish();
//
// Ids are indices in the lists of TraceAnalysis::objects() and processes(). These lists grow while the trace is read,
// and what they hold of an object may become more: a timer gets its node after its first callback, for example. So
// names are best looked up at the end. All times are nanoseconds since the epoch on the tracer's clock.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// A thread of a traced process.
struct ThreadId {
  ProcessId process = kNoProcess;
  std::int64_t vtid = 0;
  bool operator==(const ThreadId&) const = default;
};

struct HashThreadId {
  std::size_t operator()(const ThreadId& thread) const {
    return static_cast<std::size_t>(thread.vtid) * 0x9e3779b97f4a7c15 ^ static_cast<std::size_t>(thread.process);
  }
};

// A callback that ran from its begin to its end. Told at its end, so instances come in the order of their ends.
struct CallbackInstance {
  ThreadId thread;
  ObjectId callback = kNoObject;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool intra_process = false;  // the message came without the middleware
  bool nested = false;         // it ran within another callback of its thread, which spun
  // False when the trace does not hold the end: an exception, a killed process, or the trace ended before. `end_ns` is
  // then the latest time at which it may have ended.
  bool finished = true;
  // With events of the kernel's scheduler about its thread: for how long the thread waited for a processor, and was
  // blocked, in this time.
  bool is_scheduled = false;
  std::int64_t runnable_ns = 0;
  std::int64_t blocked_ns = 0;
};

// A message that a publisher handed to the middleware, or to the subscriptions of its own process.
struct Publication {
  std::uint64_t number = 0;  // counts the publications of the trace from 1; 0: the publication is not in the trace
  ObjectId topic = kNoObject;
  ObjectId publisher = kNoObject;
  ThreadId thread;
  // The begin of publishing in each layer; 0 where the trace does not hold it.
  std::int64_t rclcpp_ns = 0;
  std::int64_t rcl_ns = 0;
  std::int64_t published_ns = 0;  // rmw_publish, or rclcpp_intra_publish
  std::int64_t written_ns = 0;    // dds:write, if it came before the message was taken; 0: not in the trace
  bool intra_process = false;
};

// The way of one message to one subscription. Told when its callback begins.
struct MessageFlow {
  Publication publication;  // published_ns is 0 and publisher kNoObject when the publication is not in the trace
  ObjectId subscription = kNoObject;
  ThreadId taking_thread;
  std::int64_t taken_ns = 0;  // rmw_take, or rclcpp_ring_buffer_dequeue
  // How much of the time from published_ns to taken_ns a thread of the executor waited for work, so that it could have
  // taken the message. Nullopt when the trace does not tell.
  std::optional<std::int64_t> executor_waited_ns;
  ObjectId callback = kNoObject;       // kNoObject: the thread gave the message to no callback
  std::int64_t callback_begin_ns = 0;  // it runs in the taking thread; 0 without a callback
  // Without a callback: the message has arrived nevertheless. A waitable has taken it, such as a client of an action,
  // or the program, which has asked for it.
  bool needs_no_callback = false;
  // The trace has no timestamp of the publication: which one it is was found by its time.
  bool is_estimated = false;
  // The publication is not known because publications of the topic have no timestamps.
  bool is_unidentified = false;
};

// A request to a service and its response. Told when the response is taken.
struct ServiceCall {
  ObjectId client = kNoObject;
  ObjectId service = kNoObject;  // kNoObject when the service is not in the trace
  std::int64_t sent_ns = 0;      // rmw_send_request, which is recorded when the request is on its way already
  std::int64_t taken_ns = 0;     // rmw_take_request; 0 when it is not in the trace
  std::int64_t answered_ns = 0;  // rmw_send_response; 0 when it is not in the trace
  std::int64_t received_ns = 0;  // rmw_take_response
};

// A thread of an executor waited for work. Told at its end.
struct ExecutorWait {
  ThreadId thread;
  std::int64_t begin_ns = 0;  // rclcpp_executor_wait_for_work
  std::int64_t end_ns = 0;    // rclcpp_executor_get_next_ready
};

// A thread of an executor looks for something that is ready. Of the threads of one executor only one at a time looks or
// waits. Told before the wait that follows if nothing is ready.
struct ExecutorLook {
  ThreadId thread;
  std::int64_t time_ns = 0;  // rclcpp_executor_get_next_ready
};

// User code has declared which subscriptions cause what these publishers send: each message depends on the last one
// that each subscription got.
struct MessageLink {
  std::vector<ObjectId> subscriptions;
  std::vector<ObjectId> publishers;
};

// How long a lifecycle node was in a state. Told when it leaves the state, and at the end of the trace.
struct LifecycleInterval {
  ObjectId node = kNoObject;  // kNoObject when its initialisation is not in the trace
  std::string_view state;     // "unconfigured", "configuring", …
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool ended = true;  // false: the trace ended before the state
};

// What a thread did on the machine, from events of the kernel's scheduler. Told when it changes.
struct ThreadInterval {
  enum class State : std::uint8_t {
    kRunning,   // on a processor
    kRunnable,  // it waited for a processor
    kBlocked,   // it slept, or waited for something else
  };
  State state = State::kRunning;
  ThreadId thread;  // of a traced process
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  std::int64_t cpu = 0;  // where it ran, or was to run
  // Runnable: the thread that had the processor for which this one waited for the longest time. Empty: none.
  std::string_view other_name;
  std::int64_t other_tid = 0;
  std::int64_t other_ns = 0;  // how long
};

// A thread waited for a processor while it ran a callback. Told beside the ThreadInterval.
struct CallbackWait {
  ObjectId callback = kNoObject;
  std::int64_t took_ns = 0;
  // As those of the ThreadInterval.
  std::string_view other_name;
  std::int64_t other_ns = 0;
};

// Memory that a thread asked the C library for.
struct Allocation {
  ThreadId thread;
  std::int64_t time_ns = 0;
  std::uint64_t bytes = 0;
  ObjectId callback = kNoObject;  // the innermost one that the thread runs; kNoObject: none
};

// Overrides what it wants to know. An exception thrown here ends the reading.
class ExecutionSink {
 public:
  virtual ~ExecutionSink() = default;
  // Before anything that happens in the callback; its end is not known yet.
  virtual void on_callback_begin(const CallbackInstance&) {}
  virtual void on_callback(const CallbackInstance&) {}
  virtual void on_publication(const Publication&) {}
  virtual void on_message(const MessageFlow&) {}
  virtual void on_message_link(const MessageLink&) {}
  virtual void on_call(const ServiceCall&) {}
  // A call of which the trace does not hold the request or the taken response: what is not there is 0. Told at the end,
  // or when it is forgotten.
  virtual void on_open_call(const ServiceCall&) {}
  virtual void on_executor_wait(const ExecutorWait&) {}
  virtual void on_executor_look(const ExecutorLook&) {}
  virtual void on_lifecycle_state(const LifecycleInterval&) {}
  virtual void on_thread_state(const ThreadInterval&) {}
  virtual void on_callback_wait(const CallbackWait&) {}
  virtual void on_allocation(const Allocation&) {}
};

}  // namespace tracing
