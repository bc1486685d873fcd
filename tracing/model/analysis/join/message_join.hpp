// SPDX-License-Identifier: Apache-2.0
// Joins the events of each message, through the middleware or within the process, and tells a sink its way.
//
// A publication is what the publish functions of one thread say one after another. A message goes from there to the
// thread that takes it, and to the next callback of that thread.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/analysis/join/thread_state.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/executor_waits.hpp"
#include "tracing/model/messages/intra_process_matcher.hpp"
#include "tracing/model/messages/message_matcher.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

struct MessageCounts {
  std::uint64_t publications = 0;          // those that the sink was told
  std::uint64_t internal = 0;              // published or taken by the middleware for itself
  std::uint64_t unknown = 0;               // published or taken by objects whose initialisation is not in the trace
  std::uint64_t unknown_publications = 0;  // part of unknown
  std::uint64_t unknown_in_whole = 0;      // part of unknown: of processes that began within the trace
  // Published without a publisher, as ros2_tracing before 8.0 records it, and the trace has no rcl_publish that tells
  // it.
  std::uint64_t unnamed = 0;
  std::uint64_t logs = 0;  // on /rosout, by one of several nodes of a process
};

class MessageJoin {
 public:
  // All must outlive this object.
  MessageJoin(const ObjectModel& model, const ExecutorWaits& waits, ExecutionSink& sink)
      : model_(model), waits_(waits), sink_(sink) {
    messages_.compare_clocks_by(
        [this](ProcessId process, ProcessId other) { return model_.are_on_one_host(process, other); });
  }
  MessageJoin(const MessageJoin&) = delete;  // its parts refer to it
  MessageJoin& operator=(const MessageJoin&) = delete;

  void on(const Origin& origin, const ros2::RclInit& event) {
    begun_.insert(origin.process);
    versions_.emplace(event.version);
  }
  // Called when the model has the publisher.
  void on_publisher(const Origin& origin, const ros2::RclPublisherInit& event);
  // `thread`: that of the event. The caller keeps it between events.
  void on(const Origin& origin, ThreadState& thread, const ros2::RclcppPublish& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RclPublish& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RmwPublish& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RmwTake& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RclcppIntraPublish& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RclcppRingBufferEnqueue& event);
  void on(const Origin& origin, ThreadState& thread, const ros2::RclcppRingBufferDequeue& event);
  void on(const Origin&, ThreadState& thread, const ros2::RclcppExecutorExecute& event) {
    thread.executed = event.handle;
    tells_executions_ = true;
  }
  void on(const Origin& origin, const ros2::RclcppRingBufferClear& event) { buffers_.clear(origin, event); }
  void on(const Origin& origin, const ros2::RclcppConstructRingBuffer& event) { buffers_.on(origin, event); }
  void on(const Origin& origin, const ros2::RclcppBufferToIpb& event) { buffers_.on(origin, event); }
  void on(const Origin& origin, const ros2::RclcppIpbToSubscription& event) { buffers_.on(origin, event); }
  void on(const Origin& origin, const ros2::MessageLinkPeriodicAsync& event) { link(origin, event.subs, event.pubs); }
  void on(const Origin& origin, const ros2::MessageLinkPartialSync& event) { link(origin, event.subs, event.pubs); }

  // dds:write, of middleware that records it: what the thread has published last.
  void on_write(const Origin& origin, ThreadState& thread, std::int64_t source_timestamp);

  // The thread does something else than publishing.
  void go_on(const Origin& origin, ThreadState& thread) {
    if (thread.untimed) [[unlikely]] {
      close(origin, thread);
    }
  }

  // The thread begins a callback, which gets the message that the thread has taken.
  void on_callback(const Origin& origin, ThreadState& thread, ObjectId callback, bool intra_process);
  // No callback of the thread gets what it has taken.
  void give_to_none(const Origin& origin, ThreadState& thread);
  // At the end of the trace.
  void finish();

  const std::set<std::string, std::less<>>& versions() const { return versions_; }  // of tracetools
  // There is rcl_publish, and neither rmw_publish nor rmw_take.
  bool lacks_middleware() const { return tells_publishers_ && !tells_middleware_; }
  const MessageCounts& counts() const { return counts_; }
  const MessageMatcher& through_middleware() const { return messages_; }
  const IntraProcessMatcher& within_processes() const { return buffers_; }

 private:
  // The publisher of a message that is published; `id` is that of a known one.
  RmwLookup publisher_of(const Origin& origin, const ThreadState& thread, const ros2::RmwPublish& event) const;
  struct LogPublisher {
    ObjectId id = kNoObject;  // kNoObject: one of several
    bool exists = false;
  };
  LogPublisher log_publisher(const Origin& origin, const ThreadState& thread, ros2::Handle message) const;
  void count_unknown(const Origin& origin);
  void close(const Origin& origin, ThreadState& thread);
  // A callback begins that gets a message, if it is that of a subscription, and the trace has no take of it.
  void deliver_unrecorded(ObjectId callback);
  // The thread gives its message to `callback`, or to none.
  void tell_taken(const Origin& origin, ThreadState& thread, ObjectId callback);
  bool needs_no_callback(const ThreadState& thread) const;
  void tell_buffered(const Origin& origin, ThreadState& thread, ObjectId callback);
  void link(const Origin& origin, const std::vector<ros2::Handle>& subscriptions,
            const std::vector<ros2::Handle>& publishers);

  const ObjectModel& model_;
  const ExecutorWaits& waits_;
  ExecutionSink& sink_;
  MessageMatcher messages_;
  IntraProcessMatcher buffers_{model_};
  bool tells_executions_ = false;                           // the trace has rclcpp_executor_execute
  bool tells_publishers_ = false;                           // the trace has rcl_publish
  bool tells_middleware_ = false;                           // rmw_publish or rmw_take
  std::map<ProcessId, std::set<ObjectId>> log_publishers_;  // of /rosout, one of each node
  std::set<ProcessId> begun_;                               // processes with rcl_init
  std::set<std::string, std::less<>> versions_;             // that these have named
  MessageCounts counts_;
};

}  // namespace tracing
