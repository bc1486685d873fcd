// SPDX-License-Identifier: Apache-2.0
// Callback durations, topic latencies and calls of services from the events of ros2_tracing.
//
// Feed the events of all processes in the order of time, then ask once for the results. The memory grows with the
// number of objects, threads and topics, not with the number of events (see DurationStatistics, MessageMatcher,
// ServiceMatcher).
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "tracing/analysis/callback_tracker.hpp"
#include "tracing/analysis/execution_tracker.hpp"
#include "tracing/analysis/message_matcher.hpp"
#include "tracing/analysis/object_model.hpp"
#include "tracing/analysis/results.hpp"
#include "tracing/analysis/service_matcher.hpp"
#include "tracing/reader/ros2_events.hpp"

namespace tracing {

class Ros2Analysis {
 public:
  Ros2Analysis() = default;
  Ros2Analysis(Ros2Analysis&&) = default;  // not copyable: last_thread_ points into threads_
  Ros2Analysis& operator=(Ros2Analysis&&) = default;

  void on_event(const Origin& origin, const ros2::AnyEvent& event);
  void on_end(const Origin& origin, const ros2::ObjectEnd& end) { model_.on(origin, end); }
  void on_execution(const Origin& origin, const ros2::ExecutionEvent& event);
  Ros2Results finish();

  const ObjectModel& model() const { return model_; }

 private:
  struct Thread {
    std::vector<ActiveCallback> active_callbacks;
    std::optional<TakenMessage> taken;
    std::optional<ActiveExecution> execution;
    ros2::Handle rcl_publisher = 0;  // handle of the thread's last rcl_publish, which its rmw_publish follows
    ros2::Handle rcl_message = 0;
  };
  struct ThreadKey {
    Vpid vpid;
    std::int64_t vtid;
    bool operator==(const ThreadKey&) const = default;
  };
  struct HashThreadKey {
    std::size_t operator()(const ThreadKey& key) const;
  };

  template <class Event>
  void handle(const Origin& origin, const Event& event);
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
  Thread& thread(const Origin& origin);
  ros2::Gid gid_of(ObjectId client) const;

  CallbackResult callback_result(ObjectId id) const;
  TopicResult topic_result(ObjectId id) const;
  CallResult call_result(const ServiceMatcher::Pair& pair, const CallRecord& record) const;
  ExecutionResult execution_result(const Served& served, const ExecutionRecord& record) const;

  ObjectModel model_;
  CallbackTracker callbacks_;
  MessageMatcher messages_;
  ServiceMatcher calls_;
  ExecutionTracker executions_;
  std::unordered_map<ThreadKey, Thread, HashThreadKey> threads_;
  ThreadKey last_thread_key_{-1, -1};  // consecutive events often come from one thread
  Thread* last_thread_ = nullptr;
  std::uint64_t internal_messages_ = 0;
  std::uint64_t unknown_messages_ = 0;
};

}  // namespace tracing
