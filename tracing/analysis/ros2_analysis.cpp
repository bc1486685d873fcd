// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/ros2_analysis.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "tracing/analysis/callback_symbol.hpp"

namespace tracing {

std::size_t Ros2Analysis::HashThreadKey::operator()(const ThreadKey& key) const {
  return static_cast<std::size_t>(key.vtid) * 0x9e3779b97f4a7c15 ^ static_cast<std::size_t>(key.vpid);
}

Ros2Analysis::Thread& Ros2Analysis::thread(const Origin& origin) {
  const ThreadKey key{origin.vpid, origin.vtid};
  if (last_thread_ == nullptr || !(key == last_thread_key_)) {
    last_thread_ = &threads_[key];
    last_thread_key_ = key;
  }
  return *last_thread_;
}

void Ros2Analysis::on_event(const Origin& origin, const ros2::AnyEvent& event) {
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

void Ros2Analysis::on(const Origin& origin, const ros2::RclPublish& event) {
  Thread& publishing = thread(origin);
  publishing.rcl_publisher = event.publisher_handle;
  publishing.rcl_message = event.message;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwPublish& event) {
  RmwLookup publisher = model_.rmw_publisher(origin.vpid, event.rmw_publisher_handle);
  if (publisher.kind == RmwHandle::kUnknown) {
    // ros2_tracing before 8.0 records only the message: its rcl_publish came just before, in the same thread.
    const Thread& publishing = thread(origin);
    if (publishing.rcl_message == event.message) {
      publisher.id = model_.publisher(origin.vpid, publishing.rcl_publisher);
      if (publisher.id != kNoObject) publisher.kind = RmwHandle::kKnown;
    }
  }
  if (publisher.kind == RmwHandle::kInternal) {
    ++internal_messages_;
  } else if (publisher.kind == RmwHandle::kUnknown) {
    ++unknown_messages_;
  } else {
    messages_.publish(model_.publishers()[publisher.id].topic, event.timestamp, origin.time_ns);
  }
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTake& event) {
  Thread& taking = thread(origin);
  taking.taken.reset();
  if (!event.taken) return;
  const RmwLookup subscription = model_.rmw_subscription(origin.vpid, event.rmw_subscription_handle);
  if (subscription.kind == RmwHandle::kInternal) {
    ++internal_messages_;
  } else if (subscription.kind == RmwHandle::kUnknown) {
    ++unknown_messages_;
  } else {
    const ObjectId topic = model_.subscriptions()[subscription.id].topic;
    taking.taken = messages_.take(subscription.id, topic, event.source_timestamp);
  }
}

void Ros2Analysis::on(const Origin& origin, const ros2::CallbackStart& event) {
  Thread& running = thread(origin);
  const ObjectId id = model_.callback(origin.vpid, event.callback);
  callbacks_.start(running.active_callbacks, {event.callback, id, origin.time_ns, event.is_intra_process});
  if (event.is_intra_process || !running.taken) return;
  // The next callback of the thread gets the message. If it belongs to another subscription, the callback was disabled.
  const CallbackObject& callback = model_.callbacks()[id];
  const bool gets_it = callback.owner == CallbackObject::Owner::kUnknown ||
                       model_.subscription_of(callback) == running.taken->subscription;
  if (gets_it) messages_.deliver(*running.taken, origin.time_ns);
  running.taken.reset();
}

void Ros2Analysis::on(const Origin& origin, const ros2::CallbackEnd& event) {
  callbacks_.end(thread(origin).active_callbacks, event.callback, origin.time_ns);
}

// A client without its rmw_client_init gets an identity of its own, so that its requests are still found when its
// responses come.
ros2::Gid Ros2Analysis::gid_of(ObjectId client) const {
  ros2::Gid gid = model_.clients()[client].gid;
  if (gid.size == 0) std::memcpy(gid.bytes.data(), &client, sizeof client);
  return gid;
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwSendRequest& event) {
  const ObjectId client = model_.rmw_client(origin.vpid, event.rmw_client_handle);
  if (client == kNoObject) return;
  calls_.send_request(client, gid_of(client), event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTakeRequest& event) {
  if (!event.taken) return;
  calls_.take_request(model_.rmw_service(origin.vpid, event.rmw_service_handle), event.client_gid,
                      event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwSendResponse& event) {
  calls_.send_response(model_.rmw_service(origin.vpid, event.rmw_service_handle), event.client_gid,
                       event.sequence_number, origin.time_ns);
  executions_.end(thread(origin).execution, ros2::ExecutionEvent::Kind::kService, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RmwTakeResponse& event) {
  const ObjectId client = model_.rmw_client(origin.vpid, event.rmw_client_handle);
  if (!event.taken || client == kNoObject) return;
  calls_.take_response(gid_of(client), event.sequence_number, origin.time_ns);
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorGetNextReady&) {
  thread(origin).execution.reset();
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorWaitForWork&) {
  thread(origin).execution.reset();
}

void Ros2Analysis::on(const Origin& origin, const ros2::RclcppExecutorExecute&) {
  thread(origin).execution.reset();
}

void Ros2Analysis::on_execution(const Origin& origin, const ros2::ExecutionEvent& event) {
  using Kind = ros2::ExecutionEvent::Kind;
  Thread& running = thread(origin);
  if (event.kind == Kind::kClientCallbackStart) {
    const ObjectId callback = model_.client_callback(origin.vpid, event.handle);
    callbacks_.start(running.active_callbacks, {event.handle, callback, origin.time_ns, false});
    return;
  }
  if (event.kind == Kind::kClientCallbackEnd) {
    callbacks_.end(running.active_callbacks, event.handle, origin.time_ns);
    executions_.end(running.execution, Kind::kClient, origin.time_ns);
    return;
  }
  Served served{origin.vpid, event.kind, kNoObject, 0};
  if (event.kind == Kind::kService) served.id = model_.service(origin.vpid, event.handle);
  if (event.kind == Kind::kClient) served.id = model_.client(origin.vpid, event.handle);
  if (served.id == kNoObject) served.address = event.handle;
  executions_.start(running.execution, served, origin.time_ns);
}

CallbackResult Ros2Analysis::callback_result(ObjectId id) const {
  const CallbackObject& callback = model_.callbacks()[id];
  const CallbackRecord& record = callbacks_.records()[id];
  CallbackResult result;
  result.vpid = callback.vpid;
  result.address = callback.address;
  result.symbol = readable_symbol(callback.symbol);
  result.durations = record.durations.summary();
  result.intra_process = record.intra_process;
  result.unfinished = record.unfinished;

  ObjectId node = kNoObject;
  const ObjectId subscription = model_.subscription_of(callback);
  if (subscription != kNoObject) {
    node = model_.subscriptions()[subscription].node;
    result.owner = CallbackResult::Owner::kSubscription;
    result.owner_name = model_.topics()[model_.subscriptions()[subscription].topic].name;
  } else if (callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject) {
    node = model_.timers()[callback.owner_id].node;
    result.owner = CallbackResult::Owner::kTimer;
    result.period_ns = model_.timers()[callback.owner_id].period_ns;
  } else if (callback.owner == CallbackObject::Owner::kService && callback.owner_id != kNoObject) {
    node = model_.services()[callback.owner_id].node;
    result.owner = CallbackResult::Owner::kService;
    result.owner_name = model_.services()[callback.owner_id].name;
  } else if (callback.owner == CallbackObject::Owner::kClient) {
    result.owner = CallbackResult::Owner::kClient;
    if (callback.owner_id != kNoObject) {
      node = model_.clients()[callback.owner_id].node;
      result.owner_name = model_.clients()[callback.owner_id].name;
    }
  }
  if (node != kNoObject) result.node = model_.nodes()[node].name;
  return result;
}

TopicResult Ros2Analysis::topic_result(ObjectId id) const {
  TopicResult result;
  result.name = model_.topics()[id].name;
  result.publishers = model_.topics()[id].publishers;
  result.subscriptions = model_.topics()[id].subscriptions;
  if (id >= messages_.records().size()) return result;
  const TopicRecord& record = messages_.records()[id];
  result.published = record.published;
  result.received = record.received;
  result.published_only = record.published_only;
  result.received_only = record.received_only;
  result.latency = record.latency.summary();
  return result;
}

CallResult Ros2Analysis::call_result(const ServiceMatcher::Pair& pair, const CallRecord& record) const {
  CallResult result;
  const auto& [client, service] = pair;
  const auto fill = [this](ObjectId node, std::optional<std::int64_t>& vpid, std::string& name) {
    if (node == kNoObject) return;
    vpid = model_.nodes()[node].vpid;
    name = model_.nodes()[node].name;
  };
  if (service != kNoObject) {
    result.service = model_.services()[service].name;
    fill(model_.services()[service].node, result.server_vpid, result.server);
  }
  if (client != kNoObject) {
    result.service = model_.clients()[client].name;
    fill(model_.clients()[client].node, result.client_vpid, result.client);
  }
  result.requests = record.requests;
  result.responses = record.responses;
  result.round_trip = record.round_trip.summary();
  result.request = record.request.summary();
  result.in_service = record.service.summary();
  result.response = record.response.summary();
  return result;
}

ExecutionResult Ros2Analysis::execution_result(const Served& served, const ExecutionRecord& record) const {
  using Kind = ros2::ExecutionEvent::Kind;
  ExecutionResult result;
  result.vpid = served.vpid;
  result.address = served.address;
  result.count = record.count;
  result.durations = record.durations.summary();
  ObjectId node = kNoObject;
  if (served.kind == Kind::kService) {
    if (served.id != kNoObject) {
      node = model_.services()[served.id].node;
      result.service = model_.services()[served.id].name;
    }
  } else if (served.kind == Kind::kClient) {
    result.kind = ExecutionResult::Kind::kClient;
    if (served.id != kNoObject) {
      node = model_.clients()[served.id].node;
      result.service = model_.clients()[served.id].name;
    }
  } else {
    result.kind = ExecutionResult::Kind::kWaitable;
  }
  if (node != kNoObject) result.node = model_.nodes()[node].name;
  return result;
}

Ros2Results Ros2Analysis::finish() {
  for (const auto& [key, state] : threads_) callbacks_.abandon(state.active_callbacks);
  threads_.clear();
  last_thread_ = nullptr;
  messages_.finish();
  calls_.finish();

  Ros2Results results;
  for (ObjectId id = 0; id < callbacks_.records().size(); ++id) {
    CallbackResult result = callback_result(id);
    if (result.durations.count > 0 || result.unfinished > 0) results.callbacks.push_back(std::move(result));
  }
  std::stable_sort(results.callbacks.begin(), results.callbacks.end(),
                   [](const CallbackResult& left, const CallbackResult& right) {
                     return std::tie(left.vpid, left.node, left.owner, left.owner_name, left.period_ns) <
                            std::tie(right.vpid, right.node, right.owner, right.owner_name, right.period_ns);
                   });
  for (ObjectId id = 0; id < model_.topics().size(); ++id) results.topics.push_back(topic_result(id));
  std::sort(results.topics.begin(), results.topics.end(),
            [](const TopicResult& left, const TopicResult& right) { return left.name < right.name; });
  for (const auto& [pair, record] : calls_.records()) results.calls.push_back(call_result(pair, record));
  std::sort(results.calls.begin(), results.calls.end(), [](const CallResult& left, const CallResult& right) {
    return std::tie(left.service, left.client, left.client_vpid, left.server, left.server_vpid) <
           std::tie(right.service, right.client, right.client_vpid, right.server, right.server_vpid);
  });
  for (const auto& [served, record] : executions_.records()) {
    results.executions.push_back(execution_result(served, record));
  }
  results.internal_messages = internal_messages_;
  results.unknown_messages = unknown_messages_;
  return results;
}

}  // namespace tracing
