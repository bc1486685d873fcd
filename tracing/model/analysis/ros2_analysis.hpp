// SPDX-License-Identifier: Apache-2.0
// Callback durations, topic latencies and calls of services from the events of ros2_tracing.
//
// Feed the events of all processes in the order of time, then ask once for the results. The memory grows with the
// number of objects, threads and topics, not with the number of events (see DurationStatistics, MessageMatcher,
// ServiceMatcher).
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/allocation_counter.hpp"
#include "tracing/model/execution/callback_timing.hpp"
#include "tracing/model/execution/callback_tracker.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/execution_tracker.hpp"
#include "tracing/model/execution/executor_load.hpp"
#include "tracing/model/execution/first_activity.hpp"
#include "tracing/model/execution/lifecycle_tracker.hpp"
#include "tracing/model/execution/scheduler_tracker.hpp"
#include "tracing/model/execution/sink_list.hpp"
#include "tracing/model/execution/thread_map.hpp"
#include "tracing/model/messages/chain_tracker.hpp"
#include "tracing/model/messages/delivery_statistics.hpp"
#include "tracing/model/messages/intra_process_matcher.hpp"
#include "tracing/model/messages/message_matcher.hpp"
#include "tracing/model/messages/service_matcher.hpp"
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
  void on_event(const Origin& origin, const ros2::AnyEvent& event);
  void on_end(const Origin& origin, const ros2::ObjectEnd& end);
  // In a state dump: the state of a lifecycle node that is older than the session.
  void on_lifecycle_state(const Origin& origin, ros2::Handle state_machine, std::string_view state);
  void on_endpoint_qos(const Origin& origin, const ros2::EndpointQosEvent& event, const ros2::EndpointQos& qos) {
    model_.on(origin, event, qos);
  }
  void on_execution(const Origin& origin, const ros2::ExecutionEvent& event);
  void on_allocation(const Origin& origin, std::uint64_t bytes);
  // Returns whether it is an event of the kernel's scheduler.
  bool on_kernel_event(const Event& event, ProcessId process) { return scheduler_.on_event(event, process); }
  // `places`: where each process is in `processes`. Empty lists leave it where it is.
  Ros2Results finish(const std::vector<std::optional<ProcessIndex>>& places = {},
                     const std::vector<ProcessResult>& processes = {});

  const ObjectModel& model() const { return model_; }
  const FirstActivity& first_activity() const { return first_activity_; }
  // So far, by ObjectId; maybe shorter than the model's lists. Periods in which the timer of a callback did not call
  // it, and messages that a subscription missed (SubscriptionResult::dropped()).
  std::vector<std::uint64_t> missed_periods() const;
  std::vector<std::uint64_t> dropped_messages() const;

 private:
  struct Thread {
    std::vector<ActiveCallback> active_callbacks;
    std::optional<TakenMessage> taken;
    std::optional<ActiveExecution> execution;
    std::optional<Publication> intra_process;  // the thread's last publication within the process
    std::optional<BufferedMessage> buffered;   // taken from a ring buffer and not yet given to a callback
    std::int64_t buffered_ns = 0;
    // The thread's last rclcpp_publish and rcl_publish, which its rmw_publish follows.
    ros2::Handle rclcpp_message = 0;
    std::int64_t rclcpp_ns = 0;
    ros2::Handle rcl_publisher = 0;
    ros2::Handle rcl_message = 0;
    std::int64_t rcl_ns = 0;
    // Of the executor that spins in this thread.
    std::int64_t free_ns = 0;   // its last wait for work began
    std::int64_t woken_ns = 0;  // that wait ended; 0: not yet
  };

  template <class Event>
  void handle(const Origin& origin, const Event& event);
  void on(const Origin& origin, const ros2::RclcppPublish& event);
  void on(const Origin& origin, const ros2::RclcppIntraPublish& event);
  void on(const Origin& origin, const ros2::RclPublish& event);
  void on(const Origin& origin, const ros2::RmwPublish& event);
  void on(const Origin& origin, const ros2::RmwTake& event);
  void on(const Origin& origin, const ros2::CallbackStart& event);
  void on(const Origin& origin, const ros2::CallbackEnd& event);
  void on(const Origin& origin, const ros2::RmwSendRequest& event);
  void on(const Origin& origin, const ros2::RmwTakeRequest& event);
  void on(const Origin& origin, const ros2::RmwSendResponse& event);
  void on(const Origin& origin, const ros2::RmwTakeResponse& event);
  void on(const Origin& origin, const ros2::RclcppExecutorGetNextReady& event);
  void on(const Origin& origin, const ros2::RclcppExecutorWaitForWork& event);
  void on(const Origin& origin, const ros2::RclcppExecutorExecute& event);
  void on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event);
  void on(const Origin& origin, const ros2::RclLifecycleTransition& event);
  void on(const Origin& origin, const ros2::RclcppConstructRingBuffer& event) { intra_process_.on(origin, event); }
  void on(const Origin& origin, const ros2::RclcppBufferToIpb& event) { intra_process_.on(origin, event); }
  void on(const Origin& origin, const ros2::RclcppIpbToSubscription& event) { intra_process_.on(origin, event); }
  void on(const Origin& origin, const ros2::RclcppRingBufferEnqueue& event);
  void on(const Origin& origin, const ros2::RclcppRingBufferDequeue& event);
  void on(const Origin& origin, const ros2::RclcppRingBufferClear& event) { intra_process_.clear(origin, event); }
  void on(const Origin& origin, const ros2::MessageLinkPeriodicAsync& event) { link(origin, event.subs, event.pubs); }
  void on(const Origin& origin, const ros2::MessageLinkPartialSync& event) { link(origin, event.subs, event.pubs); }
  void link(const Origin& origin, const std::vector<ros2::Handle>& subscriptions,
            const std::vector<ros2::Handle>& publishers);
  Thread& thread(const Origin& origin) { return threads_[{origin.process, origin.vtid}]; }
  void start(const Origin& origin, Thread& thread, const ActiveCallback& callback);
  void end(const Origin& origin, Thread& thread, ros2::Handle address);
  void tell(const ThreadId& thread, const ActiveCallback& callback, std::int64_t end_ns, bool nested, bool finished);
  // The thread has given its message to `callback`, or to none.
  void tell_message(const Origin& origin, Thread& thread, ObjectId callback);
  void tell_buffered(const Origin& origin, Thread& thread, ObjectId callback);
  ros2::Gid gid_of(ObjectId client) const;

  ProcessIndex place_of(ProcessId process) const;
  bool is_doubtful(ObjectId node) const;
  std::map<ObjectId, std::uint64_t> overwritten_in_buffers() const;  // by subscription
  CallbackResult callback_result(ObjectId id) const;
  TopicResult topic_result(ObjectId id) const;
  CallResult call_result(const ServiceMatcher::Pair& pair, const CallRecord& record) const;
  ExecutionResult execution_result(const Served& served, const ExecutionRecord& record) const;
  std::vector<SubscriptionResult> subscription_results() const;
  std::vector<ExecutorResult> executor_results() const;
  ChainResult chain_result(const ChainRecord& last) const;
  bool is_natural(const ChainRecord& last) const;
  void add_chains(Ros2Results& results) const;
  std::vector<LifecycleResult> lifecycle_results() const;
  std::vector<UnmatchedResult> unmatched_results() const;
  std::vector<NodeResult> node_results(const std::vector<CallbackResult>& callbacks) const;

  ObjectModel model_;
  CallbackTracker callbacks_;
  MessageMatcher messages_;
  ServiceMatcher calls_{&sinks_};
  ExecutionTracker executions_;
  AllocationCounter allocations_{model_};
  LifecycleTracker lifecycle_{allocations_};
  FirstActivity first_activity_{model_};
  IntraProcessMatcher intra_process_;
  CallbackTiming timing_{model_};
  DeliveryStatistics deliveries_{model_};
  ExecutorLoad executors_;
  ChainTracker chains_;
  SinkList sinks_;
  ExecutionSink* sink_ = &sinks_;
  SchedulerTracker scheduler_{sinks_};
  std::uint64_t publications_ = 0;
  ThreadMap<Thread> threads_;
  std::int64_t last_ns_ = 0;
  std::uint64_t internal_messages_ = 0;
  std::uint64_t unknown_messages_ = 0;
  // Events without the event that belongs to them.
  std::uint64_t unknown_publications_ = 0;  // part of unknown_messages_
  std::uint64_t ends_without_begin_ = 0;
  std::uint64_t unknown_clients_ = 0;
  std::vector<std::optional<ProcessIndex>> places_;
  std::vector<ProcessResult> processes_;
};

}  // namespace tracing
