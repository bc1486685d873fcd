// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/delivery_statistics.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "tracing/model/messages/hop_times.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing {

namespace {

// More than any history holds, so that what became of a message is known.
constexpr std::size_t kRemembered = 4'096;

// How many messages the history of the reader holds.
std::uint64_t queue_depth(const EndpointObject& subscription) {
  const std::uint64_t depth = subscription.qos ? subscription.qos->history_depth : subscription.queue_depth;
  if (subscription.qos && depth == 0) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  return std::max<std::uint64_t>(depth, 1);
}

// The difference, at least 0.
std::uint64_t without(std::uint64_t count, std::uint64_t others) {
  return count - std::min(count, others);
}

}  // namespace

void DeliveryStatistics::on_publication(const Publication& publication) {
  PublisherRecord& record = record_at(publishers_, publication.publisher);
  // A message goes through the middleware, too, if there are subscriptions elsewhere; it counts once here.
  if (publication.intra_process || record.intra_process == 0) {
    if (record.published + record.intra_process > 0) {
      record.intervals.add(publication.published_ns - record.last_ns);
    } else {
      record.first_ns = publication.published_ns;
    }
    record.last_ns = publication.published_ns;
  }
  if (publication.intra_process) {
    tells_intra_process_ = true;
    ++record.intra_process;
    return;
  }
  ++record.published;
  Publisher& publisher = record_at(sent_, publication.publisher);
  ++publisher.count;
  publisher.newest.push_back({publication.number, ++record_at(topic_counts_, publication.topic)});
  if (publisher.newest.size() > kRemembered) {
    publisher.newest.pop_front();
  }
}

// Messages of one publisher arrive in their order: those between the last one and this one will not come.
void DeliveryStatistics::find_gaps(const MessageFlow& message) {
  Publisher& publisher = record_at(sent_, message.publication.publisher);
  // Usually it is the last one or one of the last.
  constexpr int kLast = 8;
  const std::uint64_t number = message.publication.number;
  const auto& newest = publisher.newest;
  auto sent = newest.end();
  for (int i = 0; i < kLast && sent != newest.begin() && (sent == newest.end() || sent->number > number); ++i) {
    --sent;
  }
  if (sent != newest.end() && sent->number > number) {
    sent = std::partition_point(newest.begin(), sent, [number](const Sent& one) { return one.number < number; });
  }
  if (sent == newest.end() || sent->number != number) {
    return;
  }
  const auto index = static_cast<std::uint64_t>(sent - publisher.newest.begin());
  const std::uint64_t place = publisher.count - publisher.newest.size() + 1 + index;
  DeliveryRecord& record = record_at(subscriptions_, message.subscription);
  const Progress now{place, record.unidentified};
  const auto [found, is_first] = progress_.try_emplace({message.subscription, message.publication.publisher}, now);
  if (is_first) {
    record.before_first += without(place - 1, record.unidentified);
    return;
  }
  const Progress last = found->second;
  if (place <= last.place) {
    return;
  }
  found->second = now;
  // Of those that are missing, so many may have come.
  const std::uint64_t unidentified = record.unidentified - last.unidentified;
  const EndpointObject& subscription = model_.subscriptions()[message.subscription];
  if (subscription.qos && subscription.qos->is_filtered) {
    record.filtered += without(place - last.place - 1, unidentified);
    return;
  }
  const std::uint64_t depth = queue_depth(subscription);
  const std::uint64_t topic_count = record_at(topic_counts_, message.publication.topic);
  std::uint64_t lost = 0;
  std::uint64_t pushed_out = 0;
  for (std::uint64_t missing = last.place + 1; missing < place; ++missing) {
    const std::uint64_t back = place - missing;
    // It was older than the history of the reader is long when the reader was asked.
    const bool overwritten =
        back > index || topic_count - (sent - static_cast<std::ptrdiff_t>(back))->topic_count >= depth;
    ++(overwritten ? pushed_out : lost);
  }
  record.overwritten += without(pushed_out, without(unidentified, lost));
  count_lost(record, message, without(lost, unidentified));
}

void DeliveryStatistics::count_lost(DeliveryRecord& record, const MessageFlow& message, std::uint64_t count) const {
  record.lost += count;
  const std::optional<ros2::EndpointQos>& publisher = model_.publishers()[message.publication.publisher].qos;
  const std::optional<ros2::EndpointQos>& subscription = model_.subscriptions()[message.subscription].qos;
  if (!publisher || !subscription) {
    return;
  }
  (publisher->reliable && subscription->reliable ? record.lost_by_publisher : record.lost_in_transport) += count;
}

// A publisher with intra-process communication also publishes through the middleware if other processes listen. The
// subscriptions of its own process take that copy, too, and rclcpp drops it. ros2_tracing before 6.1 does not record
// what goes on within a process; and if publications have no timestamps, it may not be known which one it is.
bool DeliveryStatistics::is_second_copy(const MessageFlow& message) const {
  const Publication& publication = message.publication;
  if (message.callback != kNoObject || message.needs_no_callback || publication.intra_process ||
      model_.rclcpp_objects(message.subscription) < 2) {
    return false;
  }
  if (publication.number == 0) {
    return message.is_unidentified;
  }
  return publication.thread.process == message.taking_thread.process &&
         (publishers_[publication.publisher].intra_process > 0 || (message.is_estimated && !tells_intra_process_));
}

void DeliveryStatistics::on_message(const MessageFlow& message) {
  const Publication& publication = message.publication;
  const bool is_known = publication.number != 0;
  DeliveryRecord& record = record_at(subscriptions_, message.subscription);
  if (is_second_copy(message)) {
    return;  // if others of these are pushed out of the queue, nobody misses them
  }
  ++record.received;
  if (publication.intra_process) {
    ++record.intra_process;
  }
  record.estimated += message.is_estimated ? 1 : 0;
  record.unidentified += message.is_unidentified ? 1 : 0;
  const bool is_delivered = message.callback != kNoObject || message.needs_no_callback;
  ++(is_delivered ? record.delivered : record.not_executed);
  if (!is_known) {
    return;
  }
  if (!publication.intra_process) {
    find_gaps(message);
  }
  if (message.callback == kNoObject) {
    return;
  }

  const HopTimes times = hop_times(message);
  if (times.rcl_ns) {
    record.rcl.add(*times.rcl_ns);
  }
  if (times.rclcpp_ns) {
    record.rclcpp.add(*times.rclcpp_ns);
  }
  record.latency.add(times.latency_ns);
  record.take.add(times.take_ns);
  if (times.transport_ns) {
    record.transport.add(*times.transport_ns);
  }
  if (times.executor_ns) {
    record.executor.add(*times.executor_ns);
  }
}

void DeliveryStatistics::finish() {
  for (const auto& [pair, last] : progress_) {
    const auto& [subscription, publisher] = pair;
    DeliveryRecord& record = subscriptions_[subscription];
    record.after_last += without(sent_[publisher].count - last.place, record.unidentified - last.unidentified);
  }
  progress_.clear();
}

}  // namespace tracing
