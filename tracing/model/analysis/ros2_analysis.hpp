// SPDX-License-Identifier: Apache-2.0
// Callback durations, topic latencies and calls of services from the events of ros2_tracing.
//
// Feed the events of all processes in the order of time, then ask once for the results. The memory grows with the
// number of objects, threads and topics, not with the number of events (see DurationStatistics, MessageMatcher,
// ServiceMatcher).
//
// EventJoin says what the events mean. Statistics are sinks of it, and `summary/` makes results of what they hold.
#pragma once

#include <variant>
#include <vector>

#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/analysis/join/event_join.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/allocation_counter.hpp"
#include "tracing/model/execution/callback_timing.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/executor_load.hpp"
#include "tracing/model/execution/first_activity.hpp"
#include "tracing/model/execution/hold_ups.hpp"
#include "tracing/model/execution/scheduler_tracker.hpp"
#include "tracing/model/execution/sink_list.hpp"
#include "tracing/model/messages/chain_tracker.hpp"
#include "tracing/model/messages/delivery_statistics.hpp"
#include "tracing/model/objects/callback_groups.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

class Ros2Analysis {
 public:
  // Tells `sink`, unless it is null, what happened. The sink must outlive the analysis. `chains`: those with names.
  explicit Ros2Analysis(ExecutionSink* sink = nullptr, std::vector<ChainDefinition> chains = {});
  Ros2Analysis(const Ros2Analysis&) = delete;  // its parts refer to one another
  Ros2Analysis& operator=(const Ros2Analysis&) = delete;

  // Before the events of new processes.
  void learn(const ProcessTable& processes) { model_.learn(processes); }
  void on_event(const Origin& origin, const ros2::AnyEvent& event) {
    std::visit([&](const auto& known) { on_event(origin, known); }, event);
  }
  template <class Event>  // a struct of ros2::AnyEvent
  void on_event(const Origin& origin, const Event& event) {
    join_.on_event(origin, event);
  }
  void on_end(const Origin& origin, const ros2::ObjectEnd& end) { join_.on_end(origin, end); }
  // In a state dump: the state of a lifecycle node that is older than the session.
  void on_lifecycle_state(const Origin& origin, ros2::Handle state_machine, std::string_view state) {
    join_.on_lifecycle_state(origin, state_machine, state);
  }
  void on_endpoint_qos(const Origin& origin, const ros2::EndpointQosEvent& event, const ros2::EndpointQos& qos) {
    model_.on(origin, event, qos);
  }
  void on_execution(const Origin& origin, const ros2::ExecutionEvent& event) { join_.on_execution(origin, event); }
  void on_caret_event(const Origin& origin, const ros2::CaretEvent& event);
  void on_write(const Origin& origin, std::int64_t source_timestamp) { join_.on_write(origin, source_timestamp); }
  void on_allocation(const Origin& origin, std::uint64_t bytes) { join_.on_allocation(origin, bytes); }
  void on_process_end(ProcessId process, std::int64_t time_ns) { join_.on_process_end(process, time_ns); }
  // Returns whether it is an event of the kernel's scheduler.
  bool on_kernel_event(const Event& event, ProcessId process) { return scheduler_.on_event(event, process); }
  // `places`: where each process is in `processes`. Empty lists leave it where it is.
  Ros2Results finish(std::vector<std::optional<ProcessIndex>> places = {},
                     const std::vector<ProcessResult>& processes = {});

  const ObjectModel& model() const { return model_; }
  const CallbackGroups& groups() const { return groups_; }
  // Before the first event: also keeps what ChainTracker::take_passages() gives.
  void keep_chain_passages() { chains_.keep_passages(); }
  ChainTracker::Passages take_chain_passages() { return chains_.take_passages(); }
  const ChainTracker& chains() const { return chains_; }
  const FirstActivity& first_activity() const { return first_activity_; }
  // So far, by ObjectId; maybe shorter than the model's lists. Periods in which the timer of a callback did not call
  // it, and messages that a subscription missed (SubscriptionResult::dropped()).
  std::vector<std::uint64_t> missed_periods() const;
  std::vector<std::uint64_t> dropped_messages() const;
  std::uint64_t dropped_messages(ObjectId subscription) const;

 private:
  ObjectModel model_;
  CallbackGroups groups_{model_};
  CallbackTiming timing_{model_};
  HoldUps hold_ups_{model_};
  DeliveryStatistics deliveries_{model_};
  ExecutorLoad executors_;
  ChainTracker chains_;
  AllocationCounter allocations_{model_};
  FirstActivity first_activity_{model_};
  SinkList<CallbackTiming, HoldUps, DeliveryStatistics, ExecutorLoad, ChainTracker, AllocationCounter, FirstActivity>
      sinks_;
  EventJoin join_{model_, allocations_, sinks_};
  SchedulerTracker scheduler_{[this](const ThreadInterval& interval) { join_.on_thread_state(interval); }};
};

}  // namespace tracing
