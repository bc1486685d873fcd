// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/message_matcher.hpp"

namespace tracing {

void MessageMatcher::publish(ObjectId topic, std::int64_t source_timestamp, std::int64_t time_ns) {
  TopicRecord& topic_record = record(topic);
  ++topic_record.published;
  if (source_timestamp == 0) {
    ++topic_record.published_only;
    return;
  }
  Flight& flight = flights_[topic];
  if (flight.oldest_first.size() < kRemembered) {
    const auto [entry, is_new] = flight.by_source_timestamp.try_emplace(source_timestamp);
    entry->second = {time_ns, false};
    if (is_new) flight.oldest_first.push_back(source_timestamp);
    return;
  }
  // From here on the newest publication reuses the memory of the oldest one.
  auto node = flight.by_source_timestamp.extract(flight.oldest_first.front());
  flight.oldest_first.pop_front();
  if (!node.mapped().received) ++topic_record.published_only;
  node.key() = source_timestamp;
  node.mapped() = {time_ns, false};
  if (flight.by_source_timestamp.insert(std::move(node)).inserted) flight.oldest_first.push_back(source_timestamp);
}

TakenMessage MessageMatcher::take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp) {
  TopicRecord& topic_record = record(topic);
  ++topic_record.received;
  TakenMessage message{subscription, topic, std::nullopt};
  auto& publications = flights_[topic].by_source_timestamp;
  const auto found = publications.find(source_timestamp);
  if (found == publications.end()) {
    ++topic_record.received_only;
  } else {
    found->second.received = true;
    message.published_ns = found->second.published_ns;
  }
  return message;
}

void MessageMatcher::deliver(const TakenMessage& message, std::int64_t callback_start_ns) {
  if (message.published_ns) record(message.topic).latency.add(callback_start_ns - *message.published_ns);
}

void MessageMatcher::finish() {
  for (std::size_t topic = 0; topic < flights_.size(); ++topic) {
    for (const auto& [timestamp, publication] : flights_[topic].by_source_timestamp) {
      if (!publication.received) ++records_[topic].published_only;
    }
    flights_[topic] = {};
  }
}

TopicRecord& MessageMatcher::record(ObjectId topic) {
  if (topic >= records_.size()) {
    records_.resize(topic + 1);
    flights_.resize(topic + 1);
  }
  return records_[topic];
}

}  // namespace tracing
