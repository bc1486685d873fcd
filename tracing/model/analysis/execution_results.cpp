// SPDX-License-Identifier: Apache-2.0
// The results of Ros2Analysis about subscriptions, executors, chains, lifecycle nodes and unmatched events.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/ros2_analysis.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

std::map<ObjectId, std::uint64_t> Ros2Analysis::overwritten_in_buffers() const {
  std::map<ObjectId, std::uint64_t> counts;
  for (const auto& [object, count] : intra_process_.overwritten()) {
    const ObjectId subscription = model_.subscription_of_object(object.first, object.second);
    if (subscription != kNoObject) {
      counts[subscription] += count;
    }
  }
  return counts;
}

std::vector<std::uint64_t> Ros2Analysis::missed_periods() const {
  std::vector<std::uint64_t> missed;
  for (const CallbackTimingRecord& record : timing_.records()) {
    missed.push_back(record.missed);
  }
  return missed;
}

std::vector<std::uint64_t> Ros2Analysis::dropped_messages() const {
  std::vector<std::uint64_t> dropped;
  for (const DeliveryRecord& record : deliveries_.subscriptions()) {
    dropped.push_back(record.not_executed + record.overwritten + record.lost);
  }
  for (const auto& [subscription, count] : overwritten_in_buffers()) {
    if (subscription < dropped.size()) {
      dropped[subscription] += count;
    }
  }
  return dropped;
}

std::vector<SubscriptionResult> Ros2Analysis::subscription_results() const {
  std::map<ObjectId, std::uint64_t> overwritten_in_buffer = overwritten_in_buffers();
  std::vector<SubscriptionResult> results;
  for (ObjectId id = 0; id < deliveries_.subscriptions().size(); ++id) {
    const DeliveryRecord& record = deliveries_.subscriptions()[id];
    if (record.received == 0) {
      continue;
    }
    const EndpointObject& subscription = model_.subscriptions()[id];
    SubscriptionResult result;
    if (subscription.node != kNoObject) {
      result.process = place_of(model_.nodes()[subscription.node].process);
      result.node = model_.nodes()[subscription.node].name;
    }
    result.topic = model_.topics()[subscription.topic].name;
    result.queue_depth = subscription.queue_depth;
    result.received = record.received;
    result.intra_process = record.intra_process;
    result.delivered = record.delivered;
    result.not_executed = record.not_executed;
    result.overwritten = record.overwritten;
    result.overwritten_in_buffer = overwritten_in_buffer[id];
    result.lost = record.lost;
    result.lost_by_publisher = record.lost_by_publisher;
    result.lost_in_transport = record.lost_in_transport;
    result.before_first = record.before_first;
    result.after_last = record.after_last;
    result.latency = record.latency.summary();
    result.rclcpp = record.rclcpp.summary();
    result.rcl = record.rcl.summary();
    result.transport = record.transport.summary();
    result.executor = record.executor.summary();
    result.take = record.take.summary();
    result.doubtful = is_doubtful(subscription.node);
    results.push_back(std::move(result));
  }
  std::stable_sort(results.begin(), results.end(), [](const SubscriptionResult& a, const SubscriptionResult& b) {
    return std::tie(a.topic, a.node, a.process) < std::tie(b.topic, b.node, b.process);
  });
  return results;
}

std::vector<ExecutorResult> Ros2Analysis::executor_results() const {
  std::vector<ExecutorResult> results;
  for (const auto& [thread, record] : executors_.records()) {
    ExecutorResult result;
    result.process = place_of(thread.process);
    result.vtid = thread.vtid;
    result.span_ns = record.last_ns - record.first_ns;
    result.callbacks = record.callbacks;
    result.callback_ns = record.callback_ns;
    std::int64_t busy = record.callback_ns;
    if (record.waits > 0) {
      result.waited_ns = record.waited_ns;
      busy = result.span_ns - record.waited_ns;
    }
    if (result.span_ns > 0) {
      result.utilisation = static_cast<double>(busy) / static_cast<double>(result.span_ns);
    }
    result.longest_busy_ns = record.longest_busy_ns;
    result.longest_busy_begin_ns = record.longest_busy_begin_ns;
    if (record.longest_callback != kNoObject) {
      const CallbackObject& callback = model_.callbacks()[record.longest_callback];
      const std::string node = node_name(model_, callback);
      result.longest_callback = (node.empty() ? "" : node + ", ") + callback_source(model_, callback);
    }
    result.doubtful = result.process < processes_.size() && processes_[result.process].doubtful;
    results.push_back(std::move(result));
  }
  std::sort(results.begin(), results.end(), [](const ExecutorResult& a, const ExecutorResult& b) {
    return std::tie(a.process, a.vtid) < std::tie(b.process, b.vtid);
  });
  return results;
}

ChainResult Ros2Analysis::chain_result(const ChainRecord& last) const {
  ChainResult result;
  for (const ChainRecord* step = &last; step != nullptr;
       step = step->parent == kNoPath ? nullptr : &chains_.paths()[step->parent]) {
    const CallbackObject& callback = model_.callbacks()[step->callback];
    ChainResult::Step shown;
    shown.process = place_of(callback.process);
    shown.node = node_name(model_, callback);
    shown.callback = callback_source(model_, callback);
    shown.callback_id = step->callback;
    if (step->topic != kNoObject) {
      shown.topic = model_.topics()[step->topic].name;
    }
    shown.until_publish = step->until_publish.summary();
    shown.transfer = step->transfer.summary();
    shown.executor = step->executor.summary();
    shown.take = step->take.summary();
    if (shown.process < processes_.size() && processes_[shown.process].doubtful) {
      result.doubtful = true;
    }
    result.steps.insert(result.steps.begin(), std::move(shown));
  }
  result.last_callback = last.last_callback.summary();
  result.response = last.response.summary();
  result.reaction = last.reaction.summary();
  result.age = last.age.summary();
  result.longest_begin_ns = last.longest_begin_ns;
  result.longest_end_ns = last.longest_end_ns;
  result.is_loop = last.is_cut;
  return result;
}

void Ros2Analysis::add_chains(Ros2Results& results) const {
  std::vector<std::pair<std::size_t, ChainResult>> named;  // by definition
  for (const ChainRecord& last : chains_.paths()) {
    if (last.length < 2 || last.response.count() == 0) {
      continue;
    }
    for (const NamedPath& path : last.named) {
      const ChainDefinition& definition = chains_.definitions()[path.definition];
      ChainResult result = chain_result(last);
      result.name = definition.name;
      result.budget_ns = definition.budget_ns;
      result.over_budget = path.over_budget;
      named.emplace_back(path.definition, std::move(result));
    }
    if (last.named.empty() && !last.goes_on && is_natural(last)) {
      results.chains.push_back(chain_result(last));
    }
  }
  // A chain that hardly ever was gone through says little.
  const auto is_frequent = [](const ChainResult& chain) { return chain.response.count >= 5; };
  const auto comes_before = [&](const ChainResult& a, const ChainResult& b) {
    return std::pair(is_frequent(a), a.response.p99_ns) > std::pair(is_frequent(b), b.response.p99_ns);
  };
  std::stable_sort(results.chains.begin(), results.chains.end(), comes_before);
  std::stable_sort(named.begin(), named.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : comes_before(a.second, b.second);
  });
  std::vector<ChainResult> first;
  for (auto& [definition, chain] : named) {
    first.push_back(std::move(chain));
  }
  results.chains.insert(results.chains.begin(), std::make_move_iterator(first.begin()),
                        std::make_move_iterator(first.end()));
  for (const ChainDefinition& definition : chains_.definitions()) {
    const bool is_seen = std::any_of(results.chains.begin(), results.chains.end(),
                                     [&](const ChainResult& chain) { return chain.name == definition.name; });
    if (!is_seen) {
      results.unseen_chains.push_back(definition.name);
    }
  }
}

// Whether the chain began at least once without a known cause.
bool Ros2Analysis::is_natural(const ChainRecord& last) const {
  const ChainRecord* first = &last;
  while (first->parent != kNoPath) {
    first = &chains_.paths()[first->parent];
  }
  return first->is_natural;
}

std::vector<LifecycleResult> Ros2Analysis::lifecycle_results() const {
  std::vector<LifecycleResult> results;
  for (const LifecycleRecord& record : lifecycle_.records()) {
    LifecycleResult result{0, "", record.state, record.begin_ns, record.end_ns, record.ended};
    if (record.node != kNoObject) {
      result.process = place_of(model_.nodes()[record.node].process);
      result.node = model_.nodes()[record.node].name;
    }
    if (allocations_.has_allocations()) {
      result.allocations = record.of_callbacks.calls;
      result.allocated_bytes = record.of_callbacks.bytes;
      result.process_allocations = record.of_process.calls;
      result.process_allocated_bytes = record.of_process.bytes;
    }
    results.push_back(std::move(result));
  }
  std::stable_sort(results.begin(), results.end(), [](const LifecycleResult& a, const LifecycleResult& b) {
    return std::tie(a.node, a.process, a.begin_ns) < std::tie(b.node, b.process, b.begin_ns);
  });
  return results;
}

std::vector<NodeResult> Ros2Analysis::node_results(const std::vector<CallbackResult>& callbacks) const {
  std::map<std::pair<ProcessIndex, std::string>, NodeResult> nodes;
  const auto node = [&nodes](ProcessIndex process, const std::string& name) -> NodeResult& {
    NodeResult& result = nodes[{process, name}];
    result.process = process;
    result.name = name;
    return result;
  };
  for (const NodeObject& object : model_.nodes()) {
    node(place_of(object.process), object.name);
  }
  for (const CallbackResult& callback : callbacks) {
    if (callback.node.empty()) {
      continue;
    }
    NodeResult& result = node(callback.process, callback.node);
    result.callbacks += callback.durations.count;
    result.callback_ns += std::llround(callback.durations.mean_ns * static_cast<double>(callback.durations.count));
  }
  std::vector<NodeResult> results;
  for (auto& [key, result] : nodes) {
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<UnmatchedResult> Ros2Analysis::unmatched_results() const {
  std::uint64_t unfinished = 0;
  for (const CallbackRecord& record : callbacks_.records()) {
    unfinished += record.unfinished;
  }
  std::uint64_t untaken = 0;
  std::uint64_t without_subscription = 0;
  std::uint64_t unpublished = 0;
  std::uint64_t untimed = 0;
  std::uint64_t untimed_taken = 0;
  for (ObjectId topic = 0; topic < messages_.records().size(); ++topic) {
    const TopicRecord& record = messages_.records()[topic];
    (model_.topics()[topic].subscriptions == 0 ? without_subscription : untaken) += record.published_only;
    unpublished += record.received_only;
    untimed += record.untimed;
    untimed_taken += record.untimed_taken;
  }
  std::uint64_t not_executed = 0;
  for (const DeliveryRecord& record : deliveries_.subscriptions()) {
    not_executed += record.not_executed;
  }
  std::uint64_t unanswered = 0;
  for (const auto& [pair, record] : calls_.records()) {
    unanswered += record.requests - record.responses;
  }
  const BufferRecord& buffers = intra_process_.record();

  std::vector<UnmatchedResult> results;
  const auto add = [&results](const char* event, const char* reason, std::uint64_t count) {
    if (count > 0) {
      results.push_back({event, reason, count});
    }
  };
  add("callback_start", "no end: an exception, a killed process, or it ran when the trace ended", unfinished);
  add("callback_end", "no begin: it ran when the trace began, or the begin was lost", ends_without_begin_);
  add("rmw_publish", "the topic has no subscription in the trace", without_subscription);
  add("rmw_publish", "no subscription took the message: not connected, or it got lost", untaken);
  add("rmw_publish", "it has no timestamp, as in ros2_tracing before 8.0: its messages can't be followed", untimed);
  add("rmw_publish", "the creation of the publisher is not in the trace", unknown_publications_);
  add("rmw_take", "the publication is not in the trace", unpublished);
  add("rmw_take", "the publications have no timestamps", untimed_taken);
  add("rmw_take", "the creation of the subscription is not in the trace", unknown_messages_ - unknown_publications_);
  add("rmw_take", "no callback got the message", not_executed);
  add("rclcpp_ring_buffer_enqueue", "a newer message took the place of this one", buffers.overwritten);
  add("rclcpp_ring_buffer_enqueue", "the buffer was cleared", buffers.cleared);
  add("rclcpp_ring_buffer_dequeue", "the message was not put in within the trace", buffers.unknown);
  add("rmw_send_request", "no response within the trace", unanswered);
  add("rmw_send_request", "the creation of the client is not in the trace", unknown_clients_);
  return results;
}

}  // namespace tracing
