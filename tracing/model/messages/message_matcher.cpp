// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/message_matcher.hpp"

#include <algorithm>

namespace tracing {

void MessageMatcher::publish(const Publication& publication, std::int64_t source_timestamp) {
  TopicRecord& topic_record = record(publication.topic);
  ++topic_record.published;
  if (source_timestamp == 0) {
    ++topic_record.untimed;
    std::deque<Publication>& untimed = flights_[publication.topic].untimed;
    untimed.push_back(publication);
    if (untimed.size() > kRemembered) {
      untimed.pop_front();
    }
    return;
  }
  Flight& flight = flights_[publication.topic];
  const bool received = !flight.unknown.empty() && was_taken_early(topic_record, flight, publication, source_timestamp);
  flight.recent.add({source_timestamp, publication, received}, [&](const RecentPublication& oldest) {
    if (!oldest.received) {
      ++topic_record.published_only;
    }
  });
}

bool MessageMatcher::was_taken_early(TopicRecord& topic_record, Flight& flight, const Publication& publication,
                                     std::int64_t source_timestamp) {
  bool was_taken = false;
  std::erase_if(flight.unknown, [&](const auto& taken) {
    if (taken.first != source_timestamp) {
      return false;
    }
    was_taken = true;
    --topic_record.received_only;
    ++topic_record.early;
    topic_record.earliest_ns = std::max(topic_record.earliest_ns, publication.published_ns - taken.second);
    return true;
  });
  return was_taken;
}

void MessageMatcher::write(ObjectId topic, std::uint64_t number, std::int64_t source_timestamp,
                           std::int64_t written_ns) {
  TopicRecord& topic_record = record(topic);
  Flight& flight = flights_[topic];
  const auto found = std::find_if(flight.untimed.rbegin(), flight.untimed.rend(),
                                  [&](const Publication& publication) { return publication.number == number; });
  if (found == flight.untimed.rend()) {
    RecentPublication* const known = flight.recent.find(source_timestamp);
    if (known != nullptr && known->publication.number == number) {
      known->publication.written_ns = written_ns;
    }
    return;
  }
  Publication publication = *found;
  publication.written_ns = written_ns;
  flight.untimed.erase(std::next(found).base());
  --topic_record.untimed;
  --topic_record.published;
  publish(publication, source_timestamp);
}

const Publication* MessageMatcher::find_untimed(Flight& flight, ObjectId subscription, std::int64_t source_timestamp) {
  for (auto publication = flight.untimed.rbegin(); publication != flight.untimed.rend(); ++publication) {
    if (publication->published_ns > source_timestamp) {
      continue;
    }
    std::uint64_t& last = flight.last[{subscription, publication->publisher}];
    if (publication->number < last || (publication->number == last && last != 0)) {
      return nullptr;
    }
    last = publication->number;
    return &*publication;
  }
  return nullptr;
}

TakenMessage MessageMatcher::take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp,
                                  std::int64_t time_ns) {
  TopicRecord& topic_record = record(topic);
  ++topic_record.received;
  TakenMessage message{subscription, {}, time_ns};
  message.publication.topic = topic;
  Flight& flight = flights_[topic];
  RecentPublication* const found = flight.recent.find(source_timestamp);
  if (found == nullptr && topic_record.untimed > 0 && source_timestamp != 0) {
    if (const Publication* const untimed = find_untimed(flight, subscription, source_timestamp)) {
      ++topic_record.by_order;
      message.publication = *untimed;
      message.is_by_order = true;
      return message;
    }
  }
  if (found == nullptr) {
    ++(topic_record.untimed > 0 ? topic_record.untimed_taken : topic_record.received_only);
    if (topic_record.untimed == 0 && source_timestamp != 0) {
      flight.unknown.emplace_back(source_timestamp, time_ns);
    }
    if (flight.unknown.size() > kUnknown) {
      flight.unknown.pop_front();
    }
  } else {
    found->received = true;
    message.publication = found->publication;
  }
  return message;
}

void MessageMatcher::deliver(const TakenMessage& message, std::int64_t callback_start_ns) {
  if (!message.publication_is_known()) {
    return;
  }
  record(message.publication.topic).latency.add(callback_start_ns - message.publication.published_ns);
}

void MessageMatcher::finish() {
  for (std::size_t topic = 0; topic < flights_.size(); ++topic) {
    for (const RecentPublication& remembered : flights_[topic].recent.all()) {
      if (!remembered.received) {
        ++records_[topic].published_only;
      }
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
