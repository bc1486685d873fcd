// SPDX-License-Identifier: Apache-2.0
// Follows messages from the publisher to the callback that gets them, by topic and source timestamp.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tracing/analysis/duration_statistics.hpp"
#include "tracing/analysis/object_model.hpp"

namespace tracing {

// A message that a thread has taken and not yet given to a callback.
struct TakenMessage {
  ObjectId subscription = kNoObject;
  ObjectId topic = kNoObject;
  std::optional<std::int64_t> published_ns;  // time of the publication, if it was seen
};

struct TopicRecord {
  std::uint64_t published = 0;
  std::uint64_t received = 0;
  std::uint64_t published_only = 0;
  std::uint64_t received_only = 0;
  DurationStatistics latency;
};

class MessageMatcher {
 public:
  // A message can be received by any number of subscriptions. A publication is therefore remembered until this many
  // newer publications of its topic have come, which is more than any queue of a subscription holds. That bounds the
  // memory.
  static constexpr std::size_t kRemembered = 16'384;

  // `source_timestamp`: 0 when the trace doesn't hold it; such a message can be counted but not followed.
  void publish(ObjectId topic, std::int64_t source_timestamp, std::int64_t time_ns);
  TakenMessage take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp);
  // `message` reaches its callback.
  void deliver(const TakenMessage& message, std::int64_t callback_start_ns);
  // To be called at the end of the trace: a message that has not been received by now never will be.
  void finish();

  // Indexed by the topic's ObjectId; may be shorter than the model's list.
  const std::vector<TopicRecord>& records() const { return records_; }

 private:
  struct Publication {
    std::int64_t published_ns = 0;
    bool received = false;
  };
  // Two publishers of a topic with the same nanosecond would count as one: the trace can't tell them apart.
  struct Flight {
    std::unordered_map<std::int64_t, Publication> by_source_timestamp;
    std::deque<std::int64_t> oldest_first;
  };

  TopicRecord& record(ObjectId topic);

  std::vector<TopicRecord> records_;
  std::vector<Flight> flights_;  // indexed as records_
};

}  // namespace tracing
