// SPDX-License-Identifier: Apache-2.0
// Joins the events of ros2_tracing, and tells a sink what they mean: callbacks, ways of messages, calls of services,
// waits, states.
//
// Each event goes to the part that knows its subject. What several parts need to know in a certain order, such as the
// begin of a callback, is decided here.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/analysis/join/message_join.hpp"
#include "tracing/model/analysis/join/thread_state.hpp"
#include "tracing/model/execution/callback_tracker.hpp"
#include "tracing/model/execution/execution_tracker.hpp"
#include "tracing/model/execution/executor_waits.hpp"
#include "tracing/model/execution/lifecycle_tracker.hpp"
#include "tracing/model/execution/thread_map.hpp"
#include "tracing/model/messages/service_matcher.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

class EventJoin {
 public:
  // All must outlive this object. The events that begin and end objects go on to the model.
  EventJoin(ObjectModel& model, const AllocationCounter& allocations, ExecutionSink& sink)
      : model_(model),
        sink_(sink),
        callbacks_(sink),
        messages_(model, waits_, sink),
        calls_(model, sink),
        executions_(model),
        lifecycle_(model, allocations, sink) {}

  template <class Event>
  void on_event(const Origin& origin, const Event& event) {
    last_ns_ = std::max(last_ns_, origin.time_ns);  // initialisations of CARET are told later than they were recorded
    handle(origin, event);
  }
  void on_end(const Origin& origin, const ros2::ObjectEnd& end);
  void on_lifecycle_state(const Origin& origin, ros2::Handle state_machine, std::string_view state) {
    lifecycle_.state(origin, state_machine, state);
  }
  void on_write(const Origin& origin, std::int64_t source_timestamp) {
    messages_.on_write(origin, thread(origin), source_timestamp);
  }
  void on_execution(const Origin& origin, const ros2::ExecutionEvent& event);
  void on_thread_state(const ThreadInterval& interval);
  void on_allocation(const Origin& origin, std::uint64_t bytes);
  // The process was told to end, or has ended.
  void on_process_end(ProcessId process, std::int64_t time_ns) { calls_.end_process(process, time_ns); }
  // At the end of the trace. Tells what has no end.
  void finish();

  std::int64_t last_ns() const { return last_ns_; }  // of the events that it got
  const CallbackTracker& callbacks() const { return callbacks_; }
  const MessageJoin& messages() const { return messages_; }
  const ServiceMatcher& calls() const { return calls_; }
  const ExecutionTracker& executions() const { return executions_; }
  const LifecycleTracker& lifecycle() const { return lifecycle_; }

 private:
  void on(const Origin& origin, const ros2::RclPublisherInit& event) {
    model_.on(origin, event);
    messages_.on_publisher(origin, event);
  }

  // An event goes to the functions below or to the first part that has an overload for it. Some events need neither.
  template <class Event>
  void handle(const Origin& origin, const Event& event) {
    if constexpr (requires { on(origin, event); }) {
      on(origin, event);
    } else if constexpr (requires { model_.on(origin, event); }) {
      model_.on(origin, event);
    } else if constexpr (requires { messages_.on(origin, thread(origin), event); }) {
      messages_.on(origin, thread(origin), event);
    } else if constexpr (requires { messages_.on(origin, event); }) {
      messages_.on(origin, event);
    } else if constexpr (requires { calls_.on(origin, event); }) {
      calls_.on(origin, event);
    } else if constexpr (requires { lifecycle_.on(origin, event); }) {
      lifecycle_.on(origin, event);
    }
  }
  void on(const Origin& origin, const ros2::CallbackStart& event);
  void on(const Origin& origin, const ros2::CallbackEnd& event);
  void on(const Origin& origin, const ros2::RmwSendResponse& event);
  void on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event);
  void on(const Origin& origin, const ros2::RclcppExecutorGetNextReady& event);
  void on(const Origin& origin, const ros2::RclcppExecutorWaitForWork& event);
  void on(const Origin& origin, const ros2::RclcppExecutorExecute& event);
  [[gnu::always_inline]] ThreadState& thread(const Origin& origin) { return threads_[{origin.process, origin.vtid}]; }

  ObjectModel& model_;
  ExecutionSink& sink_;
  CallbackTracker callbacks_;
  ExecutorWaits waits_;
  MessageJoin messages_;
  ServiceMatcher calls_;
  ExecutionTracker executions_;
  LifecycleTracker lifecycle_;
  ThreadMap<ThreadState> threads_;
  std::int64_t last_ns_ = 0;
};

}  // namespace tracing
