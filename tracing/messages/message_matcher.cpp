// SPDX-License-Identifier: Apache-2.0
#include "tracing/messages/message_matcher.hpp"

#include <algorithm>

namespace tracing {

void MessageMatcher::publish(const Publication& publication, std::int64_t source_timestamp) {
  TopicRecord& topic_record = record(publication.topic);
  ++topic_record.published;
  if (source_timestamp == 0) {
    ++topic_record.untimed;
    return;
  }
  Flight& flight = flights_[publication.topic];
  const bool received = !flight.unknown.empty() && was_taken_early(topic_record, flight, publication, source_timestamp);
  if (flight.oldest_first.size() < kRemembered) {
    const auto [entry, is_new] = flight.by_source_timestamp.try_emplace(source_timestamp);
    entry->second = {publication, received};
    if (is_new) flight.oldest_first.push_back(source_timestamp);
    return;
  }
  // From here on the newest publication reuses the memory of the oldest one.
  auto node = flight.by_source_timestamp.extract(flight.oldest_first.front());
  flight.oldest_first.pop_front();
  if (!node.mapped().received) ++topic_record.published_only;
  node.key() = source_timestamp;
  node.mapped() = {publication, received};
  if (flight.by_source_timestamp.insert(std::move(node)).inserted) flight.oldest_first.push_back(source_timestamp);
}

bool MessageMatcher::was_taken_early(TopicRecord& topic_record, Flight& flight, const Publication& publication,
                                     std::int64_t source_timestamp) {
  bool was_taken = false;
  std::erase_if(flight.unknown, [&](const auto& taken) {
    if (taken.first != source_timestamp) return false;
    was_taken = true;
    --topic_record.received_only;
    ++topic_record.early;
    topic_record.earliest_ns = std::max(topic_record.earliest_ns, publication.published_ns - taken.second);
    return true;
  });
  return was_taken;
}

TakenMessage MessageMatcher::take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp,
                                  std::int64_t time_ns) {
  TopicRecord& topic_record = record(topic);
  ++topic_record.received;
  TakenMessage message{subscription, {}, time_ns};
  message.publication.topic = topic;
  Flight& flight = flights_[topic];
  auto& publications = flight.by_source_timestamp;
  const auto found = publications.find(source_timestamp);
  if (found == publications.end()) {
    ++(topic_record.untimed > 0 ? topic_record.untimed_taken : topic_record.received_only);
    if (topic_record.untimed == 0 && source_timestamp != 0) flight.unknown.emplace_back(source_timestamp, time_ns);
    if (flight.unknown.size() > kUnknown) flight.unknown.pop_front();
  } else {
    found->second.received = true;
    message.publication = found->second.publication;
  }
  return message;
}

void MessageMatcher::deliver(const TakenMessage& message, std::int64_t callback_start_ns) {
  if (!message.publication_is_known()) return;
  record(message.publication.topic).latency.add(callback_start_ns - message.publication.published_ns);
}

void MessageMatcher::finish() {
  for (std::size_t topic = 0; topic < flights_.size(); ++topic) {
    for (const auto& [timestamp, remembered] : flights_[topic].by_source_timestamp) {
      if (!remembered.received) ++records_[topic].published_only;
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
