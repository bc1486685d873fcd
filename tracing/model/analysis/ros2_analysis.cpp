// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/ros2_analysis.hpp"

#include <cstring>
#include <utility>

namespace tracing {

Ros2Analysis::Ros2Analysis(ExecutionSink* sink, std::vector<ChainDefinition> chains) {
  chains_.define(model_, std::move(chains));
  sinks_.add(&timing_);
  sinks_.add(&deliveries_);
  sinks_.add(&executors_);
  sinks_.add(&chains_);
  sinks_.add(&allocations_);
  sinks_.add(&first_activity_);
  if (sink != nullptr) {
    sinks_.add(sink);
  }
}

void Ros2Analysis::on_event(const Origin& origin, const ros2::AnyEvent& event) {
  last_ns_ = origin.time_ns;
  std::visit([&](const auto& known) { handle(origin, known); }, event);
}

// An event goes to the model or to the functions below, depending on which has an overload for it. Some events need
// neither.
template <class Event>
void Ros2Analysis::handle(const Origin& origin, const Event& event) {
  if constexpr (requires { model_.on(origin, event); }) {
    model_.on(origin, event);
  } else if constexpr (requires { on(origin, event); }) {
    on(origin, event);
  }
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppPublish& event) {
  Thread& publishing = thread(origin);
  publishing.rclcpp_message = event.message;
  publishing.rclcpp_ns = origin.time_ns;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclPublish& event) {
  Thread& publishing = thread(origin);
  publishing.rcl_publisher = event.publisher_handle;
  publishing.rcl_message = event.message;
  publishing.rcl_ns = origin.time_ns;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwPublish& event) {
  RmwLookup publisher = model_.rmw_publisher(origin.process, event.rmw_publisher_handle);
  Thread& publishing = thread(origin);
  if (publisher.kind == RmwHandle::kUnknown) {
    // ros2_tracing before 8.0 records only the message: its rcl_publish came just before, in the same thread.
    if (publishing.rcl_message == event.message) {
      publisher.id = model_.publisher(origin.process, publishing.rcl_publisher);
      if (publisher.id != kNoObject) {
        publisher.kind = RmwHandle::kKnown;
      }
    }
  }
  if (publisher.kind == RmwHandle::kInternal) {
    ++internal_messages_;
  } else if (publisher.kind == RmwHandle::kUnknown) {
    ++unknown_messages_;
    ++unknown_publications_;
  } else {
    Publication publication{.number = ++publications_,
                            .topic = model_.publishers()[publisher.id].topic,
                            .publisher = publisher.id,
                            .thread = {origin.process, origin.vtid},
                            .published_ns = origin.time_ns};
    if (event.message != 0 && publishing.rcl_message == event.message) {
      publication.rcl_ns = publishing.rcl_ns;
    }
    if (event.message != 0 && publishing.rclcpp_message == event.message) {
      publication.rclcpp_ns = publishing.rclcpp_ns;
    }
    messages_.publish(publication, event.timestamp);
    sink_->on_publication(publication);
  }
  // The message of an earlier publication may have had the same address.
  publishing.rcl_message = publishing.rclcpp_message = 0;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTake& event) {
  Thread& taking = thread(origin);
  if (taking.taken) {
    tell_message(origin, taking, kNoObject);
  }
  if (!event.taken) {
    return;
  }
  const RmwLookup subscription = model_.rmw_subscription(origin.process, event.rmw_subscription_handle);
  if (subscription.kind == RmwHandle::kInternal) {
    ++internal_messages_;
  } else if (subscription.kind == RmwHandle::kUnknown) {
    ++unknown_messages_;
  } else {
    const ObjectId topic = model_.subscriptions()[subscription.id].topic;
    taking.taken = messages_.take(subscription.id, topic, event.source_timestamp, origin.time_ns);
  }
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppIntraPublish& event) {
  Thread& publishing = thread(origin);
  publishing.intra_process.reset();
  const ObjectId publisher = model_.publisher(origin.process, event.publisher_handle);
  if (publisher == kNoObject) {
    ++unknown_messages_;
    ++unknown_publications_;
    return;
  }
  publishing.intra_process = Publication{.number = ++publications_,
                                         .topic = model_.publishers()[publisher].topic,
                                         .publisher = publisher,
                                         .thread = {origin.process, origin.vtid},
                                         .published_ns = origin.time_ns,
                                         .intra_process = true};
  sink_->on_publication(*publishing.intra_process);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppRingBufferEnqueue& event) {
  intra_process_.enqueue(origin, event, thread(origin).intra_process);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppRingBufferDequeue& event) {
  Thread& taking = thread(origin);
  if (taking.buffered) {
    tell_buffered(origin, taking, kNoObject);
  }
  taking.buffered = intra_process_.dequeue(origin, event);
  taking.buffered_ns = origin.time_ns;
}

void Ros2Analysis::on(const Origin& origin, const ros2::CallbackStart& event) {
  Thread& running = thread(origin);
  const ObjectId id = model_.callback(origin.process, event.callback);
  start(origin, running, {event.callback, id, origin.time_ns, event.is_intra_process});
  if (event.is_intra_process) {
    if (running.buffered) {
      tell_buffered(origin, running, id);
    }
    return;
  }
  if (!running.taken) {
    return;
  }
  // The next callback of the thread gets the message. If it belongs to another subscription, the callback was disabled.
  const CallbackObject& callback = model_.callbacks()[id];
  const bool gets_it = callback.owner == CallbackObject::Owner::kUnknown ||
                       model_.subscription_of(callback) == running.taken->subscription;
  if (gets_it) {
    messages_.deliver(*running.taken, origin.time_ns);
  }
  tell_message(origin, running, gets_it ? id : kNoObject);
}

void Ros2Analysis::on(const Origin& origin, const ros2::CallbackEnd& event) {
  end(origin, thread(origin), event.callback);
}

void Ros2Analysis::start(const Origin& origin, Thread& thread, const ActiveCallback& callback) {
  const ThreadId id{origin.process, origin.vtid};
  const std::optional<ActiveCallback> lost = callbacks_.start(thread.active_callbacks, callback);
  const bool nested = thread.active_callbacks.size() > 1;
  if (lost) {
    tell(id, *lost, origin.time_ns, nested, false);
  }
  sink_->on_callback_begin({.thread = id,
                            .callback = callback.callback,
                            .begin_ns = callback.start_ns,
                            .end_ns = callback.start_ns,
                            .intra_process = callback.intra_process,
                            .nested = nested,
                            .finished = false});
}

void Ros2Analysis::end(const Origin& origin, Thread& thread, ros2::Handle address) {
  const std::optional<ActiveCallback> ended = callbacks_.end(thread.active_callbacks, address, origin.time_ns);
  if (ended) {
    tell({origin.process, origin.vtid}, *ended, origin.time_ns, !thread.active_callbacks.empty(), true);
  } else {
    ++ends_without_begin_;
  }
}

void Ros2Analysis::tell(const ThreadId& thread, const ActiveCallback& callback, std::int64_t end_ns, bool nested,
                        bool finished) {
  sink_->on_callback({.thread = thread,
                      .callback = callback.callback,
                      .begin_ns = callback.start_ns,
                      .end_ns = end_ns,
                      .intra_process = callback.intra_process,
                      .nested = nested,
                      .finished = finished});
}

void Ros2Analysis::tell_message(const Origin& origin, Thread& thread, ObjectId callback) {
  sink_->on_message({.publication = thread.taken->publication,
                     .subscription = thread.taken->subscription,
                     .taking_thread = {origin.process, origin.vtid},
                     .taken_ns = thread.taken->taken_ns,
                     .executor_free_ns = thread.free_ns,
                     .executor_woken_ns = thread.woken_ns,
                     .callback = callback,
                     .callback_begin_ns = callback == kNoObject ? 0 : origin.time_ns});
  thread.taken.reset();
}

void Ros2Analysis::tell_buffered(const Origin& origin, Thread& thread, ObjectId callback) {
  const ObjectId subscription = model_.subscription_of_object(origin.process, thread.buffered->subscription_object);
  if (subscription != kNoObject) {
    MessageFlow flow{.publication = thread.buffered->publication,
                     .subscription = subscription,
                     .taking_thread = {origin.process, origin.vtid},
                     .taken_ns = thread.buffered_ns,
                     .executor_free_ns = thread.free_ns,
                     .executor_woken_ns = thread.woken_ns,
                     .callback = callback,
                     .callback_begin_ns = callback == kNoObject ? 0 : origin.time_ns};
    flow.publication.topic = model_.subscriptions()[subscription].topic;
    flow.publication.intra_process = true;
    sink_->on_message(flow);
  }
  thread.buffered.reset();
}

void Ros2Analysis::link(const Origin& origin, const std::vector<ros2::Handle>& subscriptions,
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
  sink_->on_message_link(link);
}

void Ros2Analysis::on_allocation(const Origin& origin, std::uint64_t bytes) {
  sink_->on_allocation({{origin.process, origin.vtid}, origin.time_ns, bytes});
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event) {
  lifecycle_.begin(origin, event.state_machine, model_.node(origin.process, event.node_handle), sink_);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclLifecycleTransition& event) {
  lifecycle_.change(origin, event.state_machine, event.start_label, event.goal_label, sink_);
}

void Ros2Analysis::on_end(const Origin& origin, const ros2::ObjectEnd& end) {
  last_ns_ = origin.time_ns;
  if (end.kind == ros2::ObjectEnd::Kind::kRclLifecycleStateMachine) {
    lifecycle_.end(origin, end.handle, sink_);
  }
  model_.on(origin, end);
}

void Ros2Analysis::on_lifecycle_state(const Origin& origin, ros2::Handle state_machine, std::string_view state) {
  lifecycle_.state(origin, state_machine, state, sink_);
}

// A client without its rmw_client_init gets an identity of its own, so that its requests are still found when its
// responses come.
ros2::Gid Ros2Analysis::gid_of(ObjectId client) const {
  ros2::Gid gid = model_.clients()[client].gid;
  if (gid.size == 0) {
    std::memcpy(gid.bytes.data(), &client, sizeof client);
  }
  return gid;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwSendRequest& event) {
  const ObjectId client = model_.rmw_client(origin.process, event.rmw_client_handle);
  if (client == kNoObject) {
    ++unknown_clients_;
    return;
  }
  calls_.send_request(client, gid_of(client), event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTakeRequest& event) {
  if (!event.taken) {
    return;
  }
  calls_.take_request(model_.rmw_service(origin.process, event.rmw_service_handle), event.client_gid,
                      event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwSendResponse& event) {
  calls_.send_response(model_.rmw_service(origin.process, event.rmw_service_handle), event.client_gid,
                       event.sequence_number, origin.time_ns);
  executions_.end(thread(origin).execution, ros2::ExecutionEvent::Kind::kService, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTakeResponse& event) {
  const ObjectId client = model_.rmw_client(origin.process, event.rmw_client_handle);
  if (!event.taken || client == kNoObject) {
    return;
  }
  calls_.take_response(gid_of(client), event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorGetNextReady&) {
  Thread& spinning = thread(origin);
  spinning.execution.reset();
  const ThreadId thread{origin.process, origin.vtid};
  if (spinning.woken_ns != 0) {
    sink_->on_executor_look({thread, origin.time_ns});
    return;
  }
  spinning.woken_ns = origin.time_ns;
  if (spinning.free_ns != 0) {
    sink_->on_executor_wait({thread, spinning.free_ns, origin.time_ns});
  }
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorWaitForWork&) {
  Thread& spinning = thread(origin);
  spinning.execution.reset();
  if (spinning.taken) {
    tell_message(origin, spinning, kNoObject);
  }
  if (spinning.buffered) {
    tell_buffered(origin, spinning, kNoObject);
  }
  spinning.free_ns = origin.time_ns;
  spinning.woken_ns = 0;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorExecute&) {
  thread(origin).execution.reset();
}

void Ros2Analysis::on_execution(const Origin& origin, const ros2::ExecutionEvent& event) {
  using Kind = ros2::ExecutionEvent::Kind;
  Thread& running = thread(origin);
  if (event.kind == Kind::kClientCallbackStart) {
    const ObjectId callback = model_.client_callback(origin.process, event.handle);
    start(origin, running, {event.handle, callback, origin.time_ns, false});
    return;
  }
  if (event.kind == Kind::kClientCallbackEnd) {
    end(origin, running, event.handle);
    executions_.end(running.execution, Kind::kClient, origin.time_ns);
    return;
  }
  Served served{origin.process, event.kind, kNoObject, 0};
  if (event.kind == Kind::kService) {
    served.id = model_.service(origin.process, event.handle);
  }
  if (event.kind == Kind::kClient) {
    served.id = model_.client(origin.process, event.handle);
  }
  if (served.id == kNoObject) {
    served.address = event.handle;
  }
  executions_.start(running.execution, served, origin.time_ns);
}

}  // namespace tracing
