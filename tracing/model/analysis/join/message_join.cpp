// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/join/message_join.hpp"

#include <utility>

namespace tracing {

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RclcppPublish& event) {
  go_on(origin, thread);
  thread.rclcpp_message = event.message;
  thread.rclcpp_ns = origin.time_ns;
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RclPublish& event) {
  go_on(origin, thread);
  tells_publishers_ = true;
  thread.rcl_publisher = event.publisher_handle;
  thread.rcl_message = event.message;
  thread.rcl_ns = origin.time_ns;
}

// ros2_tracing before 8.0 records only the message: its rcl_publish came just before, in the same thread. What the
// middleware publishes for itself has none.
RmwLookup MessageJoin::publisher_of(const Origin& origin, const ThreadState& thread,
                                    const ros2::RmwPublish& event) const {
  RmwLookup publisher = model_.rmw_publisher(origin.process, event.rmw_publisher_handle);
  if (publisher.kind == RmwHandle::kUnknown && thread.rcl_message == event.message) {
    publisher.id = model_.publisher(origin.process, thread.rcl_publisher);
    if (publisher.id != kNoObject) {
      publisher.kind = RmwHandle::kKnown;
    }
  }
  return publisher;
}

// What a node logs is published by rcl itself, with a copy of the publisher of /rosout. Its handle is the address of
// that copy, which no publisher was created with. Of several nodes of the process it is unknown which one has logged.
MessageJoin::LogPublisher MessageJoin::log_publisher(const Origin& origin, const ThreadState& thread,
                                                     ros2::Handle message) const {
  const auto logs = log_publishers_.find(origin.process);
  if (thread.rcl_message != message || thread.rclcpp_message == message || logs == log_publishers_.end()) {
    return {};
  }
  return {.id = logs->second.size() == 1 ? *logs->second.begin() : kNoObject, .exists = true};
}

void MessageJoin::on_publisher(const Origin& origin, const ros2::RclPublisherInit& event) {
  if (event.topic_name == "/rosout") {
    log_publishers_[origin.process].insert(model_.publisher(origin.process, event.publisher_handle));
  }
}

void MessageJoin::count_unknown(const Origin& origin) {
  ++counts_.unknown;
  counts_.unknown_in_whole += begun_.contains(origin.process) ? 1 : 0;
}

void MessageJoin::close(const Origin& origin, ThreadState& thread) {
  messages_.close(*thread.untimed, origin.time_ns);
  thread.untimed.reset();
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RmwPublish& event) {
  go_on(origin, thread);
  tells_middleware_ = true;
  RmwLookup publisher = publisher_of(origin, thread, event);
  LogPublisher log;
  if (publisher.kind == RmwHandle::kUnknown && event.rmw_publisher_handle == 0) {
    log = log_publisher(origin, thread, event.message);
    publisher = log.id == kNoObject ? publisher : RmwLookup{RmwHandle::kKnown, log.id};
  }
  // Some middleware does not tell of the endpoints that it makes for itself, and yet publishes and takes with them.
  const bool is_whole = begun_.contains(origin.process);
  const bool is_unasked = event.rmw_publisher_handle != 0 && tells_publishers_ && thread.rcl_message != event.message;
  if (publisher.kind == RmwHandle::kInternal || (publisher.kind == RmwHandle::kUnknown && is_whole && is_unasked)) {
    ++counts_.internal;
  } else if (publisher.kind == RmwHandle::kUnknown) {
    if (event.rmw_publisher_handle == 0 && thread.rcl_message != event.message) {
      ++counts_.unnamed;
    } else if (log.exists) {
      ++counts_.logs;
    } else {
      count_unknown(origin);
      ++counts_.unknown_publications;
    }
  } else {
    Publication publication{.number = ++counts_.publications,
                            .topic = model_.publishers()[publisher.id].topic,
                            .publisher = publisher.id,
                            .thread = {origin.process, origin.vtid},
                            .published_ns = origin.time_ns};
    if (event.message != 0 && thread.rcl_message == event.message) {
      publication.rcl_ns = thread.rcl_ns;
    }
    if (event.message != 0 && thread.rclcpp_message == event.message) {
      publication.rclcpp_ns = thread.rclcpp_ns;
    }
    thread.written_topic = publication.topic;
    thread.written_number = publication.number;
    sink_.on_publication(publication);
    messages_.publish(publication, event.timestamp);
    if (event.timestamp == 0) [[unlikely]] {
      thread.untimed = publication;
    }
  }
  if (publisher.kind != RmwHandle::kKnown) {
    thread.written_topic = kNoObject;
  }
  // The message of an earlier publication may have had the same address.
  thread.rcl_message = thread.rclcpp_message = 0;
}

void MessageJoin::on_write(const Origin& origin, ThreadState& thread, std::int64_t source_timestamp) {
  if (thread.written_topic == kNoObject) {
    return;  // a message of the middleware
  }
  messages_.write(thread.written_topic, thread.written_number, source_timestamp, origin.time_ns);
  thread.written_topic = kNoObject;
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RmwTake& event) {
  go_on(origin, thread);
  tells_middleware_ = true;
  if (thread.taken) {
    tell_taken(origin, thread, kNoObject);
  }
  if (!event.taken) {
    return;
  }
  const RmwLookup subscription = model_.rmw_subscription(origin.process, event.rmw_subscription_handle);
  const bool is_unasked = tells_executions_ && thread.executed == 0 && !thread.waits.is_known;
  if (subscription.kind == RmwHandle::kInternal ||
      (subscription.kind == RmwHandle::kUnknown && begun_.contains(origin.process) && is_unasked)) {
    ++counts_.internal;
  } else if (subscription.kind == RmwHandle::kUnknown) {
    count_unknown(origin);
  } else {
    const ObjectId topic = model_.subscriptions()[subscription.id].topic;
    thread.taken = messages_.take(subscription.id, topic, event.source_timestamp, origin.time_ns, origin.process);
    // Asked now: when it is clear that no callback runs, the subscription may be gone.
    thread.taken_for = thread.executed == 0 ? kNoObject : model_.subscription(origin.process, thread.executed);
  }
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RclcppIntraPublish& event) {
  go_on(origin, thread);
  thread.intra_process.reset();
  const ObjectId publisher = model_.publisher(origin.process, event.publisher_handle);
  if (publisher == kNoObject) {
    count_unknown(origin);
    ++counts_.unknown_publications;
    return;
  }
  thread.intra_process = Publication{.number = ++counts_.publications,
                                     .topic = model_.publishers()[publisher].topic,
                                     .publisher = publisher,
                                     .thread = {origin.process, origin.vtid},
                                     .published_ns = origin.time_ns,
                                     .intra_process = true};
  sink_.on_publication(*thread.intra_process);
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RclcppRingBufferEnqueue& event) {
  buffers_.enqueue(origin, event, thread.intra_process);
}

void MessageJoin::on(const Origin& origin, ThreadState& thread, const ros2::RclcppRingBufferDequeue& event) {
  if (thread.buffered) {
    tell_buffered(origin, thread, kNoObject);
  }
  thread.buffered = buffers_.dequeue(origin, event);
  thread.buffered_ns = origin.time_ns;
}

void MessageJoin::on_callback(const Origin& origin, ThreadState& thread, ObjectId callback, bool intra_process) {
  go_on(origin, thread);
  if (intra_process) {
    if (thread.buffered) {
      tell_buffered(origin, thread, callback);
    } else {
      deliver_unrecorded(callback);
    }
    return;
  }
  if (!thread.taken) {
    deliver_unrecorded(callback);
    return;
  }
  // The next callback of the thread gets the message. If it belongs to another subscription, the callback was disabled.
  const CallbackObject& next = model_.callbacks()[callback];
  const bool gets_it =
      next.owner == CallbackObject::Owner::kUnknown || model_.subscription_of(next) == thread.taken->subscription;
  if (gets_it) {
    messages_.deliver(*thread.taken, origin.time_ns);
  }
  tell_taken(origin, thread, gets_it ? callback : kNoObject);
}

void MessageJoin::deliver_unrecorded(ObjectId callback) {
  const ObjectId subscription = model_.subscription_of(model_.callbacks()[callback]);
  if (subscription != kNoObject) {
    messages_.deliver_unrecorded(model_.subscriptions()[subscription].topic);
  }
}

void MessageJoin::give_to_none(const Origin& origin, ThreadState& thread) {
  if (thread.taken) {
    tell_taken(origin, thread, kNoObject);
  }
  if (thread.buffered) {
    tell_buffered(origin, thread, kNoObject);
  }
}

// A waitable handles the messages of its subscription itself, such as those of an action client: rclcpp has no object
// around it. A program may also take messages of any subscription where it likes, even in a callback; an executor says
// whom it executes, or at least that it looks for work.
bool MessageJoin::needs_no_callback(const ThreadState& thread) const {
  const ObjectId subscription = thread.taken->subscription;
  const bool executed = tells_executions_ ? thread.taken_for == subscription : thread.waits.is_known;
  return model_.rclcpp_objects(subscription) == 0 || !executed;
}

void MessageJoin::tell_taken(const Origin& origin, ThreadState& thread, ObjectId callback) {
  sink_.on_message(
      {.publication = thread.taken->publication,
       .subscription = thread.taken->subscription,
       .taking_thread = {origin.process, origin.vtid},
       .taken_ns = thread.taken->taken_ns,
       .executor_waited_ns = waits_.free_ns(origin.process, thread.waits, callback,
                                            thread.taken->publication.published_ns, thread.taken->taken_ns),
       .callback = callback,
       .callback_begin_ns = callback == kNoObject ? 0 : origin.time_ns,
       .needs_no_callback = callback == kNoObject && needs_no_callback(thread),
       .is_estimated = thread.taken->is_estimated,
       .is_unidentified = thread.taken->is_unidentified});
  thread.taken.reset();
}

void MessageJoin::tell_buffered(const Origin& origin, ThreadState& thread, ObjectId callback) {
  const ObjectId subscription = thread.buffered->subscription;
  if (subscription != kNoObject) {
    MessageFlow flow{
        .publication = thread.buffered->publication,
        .subscription = subscription,
        .taking_thread = {origin.process, origin.vtid},
        .taken_ns = thread.buffered_ns,
        .executor_waited_ns = waits_.free_ns(origin.process, thread.waits, callback,
                                             thread.buffered->publication.published_ns, thread.buffered_ns),
        .callback = callback,
        .callback_begin_ns = callback == kNoObject ? 0 : origin.time_ns};
    flow.publication.topic = model_.subscriptions()[subscription].topic;
    flow.publication.intra_process = true;
    sink_.on_message(flow);
  }
  thread.buffered.reset();
}

void MessageJoin::finish() {
  if (tells_publishers_) {
    counts_.internal += std::exchange(counts_.unnamed, 0);
  }
  // ros2_tracing before 8.0 does not record what subscriptions without a type take, such as those of a recorder.
  messages_.finish([this](ObjectId topic, const MessageMatcher::Takers& takers) {
    for (ObjectId id = 0; id < model_.subscriptions().size(); ++id) {
      if (model_.subscriptions()[id].topic == topic && model_.rclcpp_objects(id) == 0 && !takers.contains(id)) {
        return true;
      }
    }
    return false;
  });
}

void MessageJoin::link(const Origin& origin, const std::vector<ros2::Handle>& subscriptions,
                       const std::vector<ros2::Handle>& publishers) {
  MessageLink link;
  for (const ros2::Handle handle : subscriptions) {
    const ObjectId subscription = model_.subscription(origin.process, handle);
    if (subscription != kNoObject) {
      link.subscriptions.push_back(subscription);
    }
  }
  for (const ros2::Handle handle : publishers) {
    const ObjectId publisher = model_.publisher(origin.process, handle);
    if (publisher != kNoObject) {
      link.publishers.push_back(publisher);
    }
  }
  sink_.on_message_link(link);
}

}  // namespace tracing
