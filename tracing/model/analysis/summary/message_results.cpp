// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

namespace {

TopicResult topic_result(const Subjects& subjects, ObjectId id, const MessageMatcher& messages,
                         const DeliveryStatistics& deliveries) {
  const ObjectModel& model = subjects.model();
  TopicResult result;
  result.name = model.topics()[id].name;
  result.publishers = model.topics()[id].publishers;
  result.subscriptions = model.topics()[id].subscriptions;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::uint64_t count = 0;
  DurationStatistics intervals;
  for (ObjectId publisher = 0; publisher < deliveries.publishers().size(); ++publisher) {
    const PublisherRecord& record = deliveries.publishers()[publisher];
    if (model.publishers()[publisher].topic != id || record.first_ns == 0) {
      continue;
    }
    count += std::max(record.published, record.intra_process);
    first_ns = first_ns == 0 ? record.first_ns : std::min(first_ns, record.first_ns);
    last_ns = std::max(last_ns, record.last_ns);
    intervals.add(record.intervals);
    result.intra_process_published += record.intra_process;
  }
  result.rate_hz = subjects.rate(count, first_ns, last_ns);
  result.interval = intervals.summary();
  for (ObjectId subscription = 0; subscription < deliveries.subscriptions().size(); ++subscription) {
    if (model.subscriptions()[subscription].topic != id) {
      continue;
    }
    result.intra_process_received += deliveries.subscriptions()[subscription].intra_process;
  }
  const auto of_topic = [id, &subjects](const EndpointObject& endpoint) {
    return endpoint.topic == id && subjects.is_doubtful(subjects.place_of(endpoint.process));
  };
  result.doubtful = std::any_of(model.publishers().begin(), model.publishers().end(), of_topic) ||
                    std::any_of(model.subscriptions().begin(), model.subscriptions().end(), of_topic);
  if (id >= messages.records().size()) {
    return result;
  }
  const TopicRecord& record = messages.records()[id];
  result.published = record.published;
  result.received = record.received;
  result.published_only = record.published_only;
  result.received_only = record.received_only;
  result.early = record.early;
  result.earliest_ns = record.earliest_ns;
  result.estimated = record.estimated;
  result.unidentified = record.unidentified;
  result.undecided = record.undecided;
  result.unrecorded = record.unrecorded;
  result.doubtful = result.doubtful || record.early > 0;
  result.latency = record.latency.summary();
  return result;
}

}  // namespace

std::vector<TopicResult> topic_results(const Subjects& subjects, const MessageMatcher& messages,
                                       const DeliveryStatistics& deliveries) {
  std::vector<TopicResult> results;
  for (ObjectId id = 0; id < subjects.model().topics().size(); ++id) {
    results.push_back(topic_result(subjects, id, messages, deliveries));
  }
  std::sort(results.begin(), results.end(),
            [](const TopicResult& left, const TopicResult& right) { return left.name < right.name; });
  return results;
}

std::vector<SubscriptionResult> subscription_results(const Subjects& subjects, const DeliveryStatistics& deliveries,
                                                     const IntraProcessMatcher& buffers) {
  const ObjectModel& model = subjects.model();
  std::map<ObjectId, std::uint64_t> overwritten_in_buffer = buffers.overwritten();
  std::vector<SubscriptionResult> results;
  const DeliveryRecord nothing;
  for (ObjectId id = 0; id < model.subscriptions().size(); ++id) {
    const DeliveryRecord& record = id < deliveries.subscriptions().size() ? deliveries.subscriptions()[id] : nothing;
    if (record.received == 0 && !overwritten_in_buffer.contains(id)) {
      continue;
    }
    const EndpointObject& subscription = model.subscriptions()[id];
    SubscriptionResult result;
    result.process = subjects.place_of(subscription.process);
    if (subscription.node != kNoObject) {
      result.node = model.nodes()[subscription.node].name;
    }
    result.topic = model.topics()[subscription.topic].name;
    result.queue_depth = subscription.queue_depth;
    result.received = record.received;
    result.intra_process = record.intra_process;
    result.delivered = record.delivered;
    result.not_executed = record.not_executed;
    result.overwritten = record.overwritten;
    result.overwritten_in_buffer = overwritten_in_buffer[id];
    result.lost = record.lost;
    result.filtered = record.filtered;
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
    result.estimated = record.estimated;
    result.unidentified = record.unidentified;
    result.doubtful = subjects.is_doubtful(result.process);
    results.push_back(std::move(result));
  }
  std::stable_sort(results.begin(), results.end(), [](const SubscriptionResult& a, const SubscriptionResult& b) {
    return std::tie(a.topic, a.node, a.process) < std::tie(b.topic, b.node, b.process);
  });
  return results;
}

}  // namespace tracing
