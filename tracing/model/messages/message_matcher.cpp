// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/message_matcher.hpp"

#include <algorithm>
#include <optional>

namespace tracing {

void MessageMatcher::publish(const Publication& publication, std::int64_t source_timestamp) {
  TopicRecord& topic_record = record(publication.topic);
  ++topic_record.published;
  Flight& flight = flights_[publication.topic];
  if (source_timestamp == 0) {
    if (!flight.untimed) {
      flight.untimed = std::make_unique<Untimed>();
    }
    flight.untimed->publications.add(publication);
    return;
  }
  const bool received = !flight.unknown.empty() && was_taken_early(topic_record, flight, publication, source_timestamp);
  add_timed(topic_record, flight, {source_timestamp, publication, received});
}

void MessageMatcher::add_timed(TopicRecord& topic_record, Flight& flight, const RecentPublication& publication) {
  flight.recent.add(publication, [&](const RecentPublication& oldest) {
    if (!oldest.received) {
      ++topic_record.published_only;
    }
  });
}

void MessageMatcher::close(const Publication& publication, std::int64_t time_ns) {
  if (Untimed* const untimed = flights_[publication.topic].untimed.get()) {
    untimed->publications.close(publication, time_ns);
  }
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
  std::optional<Publication> publication = flight.untimed ? flight.untimed->publications.extract(number) : std::nullopt;
  if (!publication) {
    RecentPublication* const known = flight.recent.find(source_timestamp);
    if (known != nullptr && known->publication.number == number) {
      known->publication.written_ns = written_ns;
    }
    return;
  }
  publication->written_ns = written_ns;
  --topic_record.published;
  publish(*publication, source_timestamp);
}

void MessageMatcher::estimate(TopicRecord& topic_record, Flight& flight, TakenMessage& message,
                              const SourceStamp& stamp) {
  const std::int64_t source_timestamp = stamp.source_timestamp;
  Untimed& untimed = *flight.untimed;
  const std::optional<Publication> publication =
      source_timestamp == 0 ? std::nullopt : untimed.publications.take(stamp, clocks_);
  if (publication) {
    ++topic_record.estimated;
    message.publication = *publication;
    message.is_estimated = true;
    add_timed(
        topic_record, flight,
        {.source_timestamp = source_timestamp, .publication = *publication, .received = true, .is_estimated = true});
    return;
  }
  ++topic_record.unidentified;
  message.is_unidentified = true;
  const bool is_repeated = source_timestamp != 0 &&
                           std::find(untimed.unidentified.rbegin(), untimed.unidentified.rend(), source_timestamp) !=
                               untimed.unidentified.rend();
  if (is_repeated) {
    return;
  }
  ++untimed.unidentified_count;
  untimed.unidentified.push_back(source_timestamp);
  if (untimed.unidentified.size() > kUnknown) {
    untimed.unidentified.pop_front();
  }
}

TakenMessage MessageMatcher::take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp,
                                  std::int64_t time_ns, ProcessId taking_process) {
  TopicRecord& topic_record = record(topic);
  ++topic_record.received;
  TakenMessage message{subscription, {}, time_ns};
  message.publication.topic = topic;
  Flight& flight = flights_[topic];
  if (flight.untimed) [[unlikely]] {
    flight.untimed->takers.insert(subscription);
  }
  RecentPublication* const found = flight.recent.find(source_timestamp);
  if (found != nullptr) {
    found->received = true;
    message.publication = found->publication;
    message.is_estimated = found->is_estimated;
    topic_record.estimated += found->is_estimated ? 1 : 0;
    return message;
  }
  if (flight.untimed) {
    estimate(topic_record, flight, message, {source_timestamp, time_ns, taking_process});
    return message;
  }
  ++topic_record.received_only;
  if (source_timestamp != 0) {
    flight.unknown.emplace_back(source_timestamp, time_ns);
  }
  if (flight.unknown.size() > kUnknown) {
    flight.unknown.pop_front();
  }
  return message;
}

void MessageMatcher::deliver(const TakenMessage& message, std::int64_t callback_start_ns) {
  if (!message.publication_is_known()) {
    return;
  }
  record(message.publication.topic).latency.add(callback_start_ns - message.publication.published_ns);
}

void MessageMatcher::finish(const std::function<bool(ObjectId, const Takers&)>& has_others) {
  for (std::size_t topic = 0; topic < flights_.size(); ++topic) {
    Flight& flight = flights_[topic];
    TopicRecord& topic_record = records_[topic];
    for (const RecentPublication& remembered : flight.recent.all()) {
      if (!remembered.received) {
        ++topic_record.published_only;
      }
    }
    if (flight.untimed) {
      const std::uint64_t left = flight.untimed->publications.count();
      const bool is_unknown = topic_record.unrecorded > 0 ||
                              (has_others && has_others(static_cast<ObjectId>(topic), flight.untimed->takers));
      topic_record.undecided = is_unknown ? left : std::min(left, flight.untimed->unidentified_count);
      topic_record.published_only += left - topic_record.undecided;
    }
    flight = {};
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
