// SPDX-License-Identifier: Apache-2.0
// The results of Ros2Analysis, from what its parts have counted and measured. execution_results.cpp has the others.
#include <algorithm>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/derived_results.hpp"
#include "tracing/model/analysis/ros2_analysis.hpp"
#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

namespace {

// In a second, from the first to the last one.
double rate(std::uint64_t count, std::int64_t first_ns, std::int64_t last_ns) {
  if (count < 2 || last_ns <= first_ns) {
    return 0;
  }
  return static_cast<double>(count - 1) * 1e9 / static_cast<double>(last_ns - first_ns);
}

}  // namespace

ProcessIndex Ros2Analysis::place_of(ProcessId process) const {
  return process < places_.size() ? places_[process].value_or(process) : process;
}

bool Ros2Analysis::is_doubtful(ObjectId node) const {
  if (node == kNoObject) {
    return false;
  }
  const ProcessIndex process = place_of(model_.nodes()[node].process);
  return process < processes_.size() && processes_[process].doubtful;
}

CallbackResult Ros2Analysis::callback_result(ObjectId id) const {
  const CallbackObject& callback = model_.callbacks()[id];
  const CallbackRecord& record = callbacks_.records()[id];
  CallbackResult result;
  result.id = id;
  result.process = place_of(callback.process);
  result.address = callback.address;
  result.symbol = readable_symbol(callback.symbol);
  result.durations = record.durations.summary();
  result.intra_process = record.intra_process;
  result.unfinished = record.unfinished;

  result.node = node_name(model_, callback);
  result.doubtful = result.process < processes_.size() && processes_[result.process].doubtful;
  if (const ObjectId subscription = model_.subscription_of(callback); subscription != kNoObject) {
    result.owner = CallbackResult::Owner::kSubscription;
    result.owner_name = model_.topics()[model_.subscriptions()[subscription].topic].name;
  } else if (callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject) {
    result.owner = CallbackResult::Owner::kTimer;
    result.period_ns = model_.timers()[callback.owner_id].period_ns;
  } else if (callback.owner == CallbackObject::Owner::kService && callback.owner_id != kNoObject) {
    result.owner = CallbackResult::Owner::kService;
    result.owner_name = model_.services()[callback.owner_id].name;
  } else if (callback.owner == CallbackObject::Owner::kClient) {
    result.owner = CallbackResult::Owner::kClient;
    if (callback.owner_id != kNoObject) {
      result.owner_name = model_.clients()[callback.owner_id].name;
    }
  }
  if (id >= timing_.records().size()) {
    return result;
  }
  const CallbackTimingRecord& timing = timing_.records()[id];
  result.rate_hz = rate(timing.begins, timing.first_begin_ns, timing.last_begin_ns);
  result.interval = timing.intervals.summary();
  result.jitter = timing.jitter.summary();
  result.missed = timing.missed;
  result.overruns = timing.overruns;
  if (timing_.has_allocations()) {
    result.allocations = timing.allocations;
  }
  result.allocated_bytes = timing.allocated_bytes;
  result.running = timing.running.summary();
  result.runnable = timing.runnable.summary();
  result.blocked = timing.blocked.summary();
  result.longest_runnable_ns = timing.longest_runnable_ns;
  result.ran_instead = timing.ran_instead;
  return result;
}

TopicResult Ros2Analysis::topic_result(ObjectId id) const {
  TopicResult result;
  result.name = model_.topics()[id].name;
  result.publishers = model_.topics()[id].publishers;
  result.subscriptions = model_.topics()[id].subscriptions;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::uint64_t count = 0;
  DurationStatistics intervals;
  for (ObjectId publisher = 0; publisher < deliveries_.publishers().size(); ++publisher) {
    const PublisherRecord& record = deliveries_.publishers()[publisher];
    if (model_.publishers()[publisher].topic != id || record.first_ns == 0) {
      continue;
    }
    count += std::max(record.published, record.intra_process);
    first_ns = first_ns == 0 ? record.first_ns : std::min(first_ns, record.first_ns);
    last_ns = std::max(last_ns, record.last_ns);
    intervals.add(record.intervals);
    result.intra_process_published += record.intra_process;
  }
  result.rate_hz = rate(count, first_ns, last_ns);
  result.interval = intervals.summary();
  for (ObjectId subscription = 0; subscription < deliveries_.subscriptions().size(); ++subscription) {
    if (model_.subscriptions()[subscription].topic != id) {
      continue;
    }
    result.intra_process_received += deliveries_.subscriptions()[subscription].intra_process;
  }
  const auto of_topic = [id, this](const EndpointObject& endpoint) {
    return endpoint.topic == id && is_doubtful(endpoint.node);
  };
  result.doubtful = std::any_of(model_.publishers().begin(), model_.publishers().end(), of_topic) ||
                    std::any_of(model_.subscriptions().begin(), model_.subscriptions().end(), of_topic);
  if (id >= messages_.records().size()) {
    return result;
  }
  const TopicRecord& record = messages_.records()[id];
  result.published = record.published;
  result.received = record.received;
  result.published_only = record.published_only;
  result.received_only = record.received_only;
  result.early = record.early;
  result.earliest_ns = record.earliest_ns;
  result.doubtful = result.doubtful || record.early > 0;
  result.latency = record.latency.summary();
  return result;
}

CallResult Ros2Analysis::call_result(const ServiceMatcher::Pair& pair, const CallRecord& record) const {
  CallResult result;
  const auto& [client, service] = pair;
  const auto fill = [this](ObjectId node, std::optional<ProcessIndex>& process, std::string& name) {
    if (node == kNoObject) {
      return;
    }
    process = place_of(model_.nodes()[node].process);
    name = model_.nodes()[node].name;
  };
  if (service != kNoObject) {
    result.service = model_.services()[service].name;
    fill(model_.services()[service].node, result.server_process, result.server);
  }
  if (client != kNoObject) {
    result.service = model_.clients()[client].name;
    fill(model_.clients()[client].node, result.client_process, result.client);
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
  result.process = place_of(served.process);
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
  if (node != kNoObject) {
    result.node = model_.nodes()[node].name;
  }
  return result;
}

Ros2Results Ros2Analysis::finish(const std::vector<std::optional<ProcessIndex>>& places,
                                 const std::vector<ProcessResult>& processes) {
  places_ = places;
  processes_ = processes;
  for (auto& [id, state] : threads_) {
    callbacks_.abandon(state.active_callbacks);
    for (const ActiveCallback& active : state.active_callbacks) {
      tell(id, active, last_ns_, false, false);
    }
    const Origin origin{last_ns_, id.process, id.vtid};
    if (state.taken) {
      tell_message(origin, state, kNoObject);
    }
    if (state.buffered) {
      tell_buffered(origin, state, kNoObject);
    }
  }
  lifecycle_.finish(last_ns_, sink_);
  threads_.clear();
  messages_.finish();
  calls_.finish();
  deliveries_.finish();
  chains_.finish();

  Ros2Results results;
  for (ObjectId id = 0; id < callbacks_.records().size(); ++id) {
    CallbackResult result = callback_result(id);
    if (result.durations.count > 0 || result.unfinished > 0) {
      results.callbacks.push_back(std::move(result));
    }
  }
  std::stable_sort(results.callbacks.begin(), results.callbacks.end(),
                   [](const CallbackResult& left, const CallbackResult& right) {
                     return std::tie(left.process, left.node, left.owner, left.owner_name, left.period_ns) <
                            std::tie(right.process, right.node, right.owner, right.owner_name, right.period_ns);
                   });
  for (ObjectId id = 0; id < model_.topics().size(); ++id) {
    results.topics.push_back(topic_result(id));
  }
  std::sort(results.topics.begin(), results.topics.end(),
            [](const TopicResult& left, const TopicResult& right) { return left.name < right.name; });
  for (const auto& [pair, record] : calls_.records()) {
    results.calls.push_back(call_result(pair, record));
  }
  std::sort(results.calls.begin(), results.calls.end(), [](const CallResult& left, const CallResult& right) {
    return std::tie(left.service, left.client, left.client_process, left.server, left.server_process) <
           std::tie(right.service, right.client, right.client_process, right.server, right.server_process);
  });
  for (const auto& [served, record] : executions_.records()) {
    results.executions.push_back(execution_result(served, record));
  }
  results.subscriptions = subscription_results();
  results.executors = executor_results();
  add_chains(results);
  results.has_all_chains = !chains_.is_full();
  results.lifecycle = lifecycle_results();
  results.unmatched = unmatched_results();
  results.actions = action_results(results);
  results.nodes = node_results(results.callbacks);
  results.internal_messages = internal_messages_;
  results.unknown_messages = unknown_messages_;
  return results;
}

}  // namespace tracing
