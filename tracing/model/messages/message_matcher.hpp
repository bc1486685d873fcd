// SPDX-License-Identifier: Apache-2.0
// Follows messages from the publisher to the callback that gets them, by topic and source timestamp.
//
// ros2_tracing before 8.0 records no timestamp of a publication. Middleware that records dds:write tells it then.
// Otherwise a message that is taken is the newest publication before its source timestamp, which the writer takes from
// the clock right after rmw_publish, and no older one than the subscription has got of the publisher already. That is
// not certain, and is marked.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/messages/recent_publications.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// A message that a thread has taken and not yet given to a callback.
struct TakenMessage {
  ObjectId subscription = kNoObject;
  Publication publication;  // has no publisher when it was not seen; its topic is always known
  std::int64_t taken_ns = 0;
  bool is_by_order = false;  // as MessageFlow::is_by_order

  bool publication_is_known() const { return publication.publisher != kNoObject; }
};

struct TopicRecord {
  std::uint64_t published = 0;
  std::uint64_t received = 0;
  std::uint64_t published_only = 0;
  std::uint64_t received_only = 0;
  std::uint64_t untimed = 0;        // part of published: without a timestamp, so it is unknown who took the message
  std::uint64_t untimed_taken = 0;  // part of received: of a topic with such messages, and not found among these
  std::uint64_t by_order = 0;       // part of received: found among these
  std::uint64_t early = 0;       // part of received: taken before the publication, which clocks that differ make of it
  std::int64_t earliest_ns = 0;  // how long before, at most
  DurationStatistics latency;
};

class MessageMatcher {
 public:
  // A message can be received by any number of subscriptions. A publication is therefore remembered until this many
  // newer publications of its topic have come, which is more than any queue of a subscription holds. That bounds the
  // memory.
  static constexpr std::size_t kRemembered = 4'096;
  // So many messages without a publication are remembered for each topic, in case it comes later.
  static constexpr std::size_t kUnknown = 64;

  // `source_timestamp`: 0 when the trace doesn't hold it.
  void publish(const Publication& publication, std::int64_t source_timestamp);
  // The middleware has written the publication, with this timestamp.
  void write(ObjectId topic, std::uint64_t number, std::int64_t source_timestamp, std::int64_t written_ns);
  TakenMessage take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp, std::int64_t time_ns);
  // `message` reaches its callback.
  void deliver(const TakenMessage& message, std::int64_t callback_start_ns);
  // To be called at the end of the trace: a message that has not been received by now never will be.
  void finish();

  // Indexed by the topic's ObjectId; may be shorter than the model's list.
  const std::vector<TopicRecord>& records() const { return records_; }

 private:
  // Two publishers of a topic with the same nanosecond would count as one: the trace can't tell them apart.
  struct Flight {
    RecentPublications recent{kRemembered};
    // The newest messages that were taken without a publication: source timestamp, time.
    std::deque<std::pair<std::int64_t, std::int64_t>> unknown;
    std::deque<Publication> untimed;                              // the newest publications without a timestamp
    std::map<std::pair<ObjectId, ObjectId>, std::uint64_t> last;  // number, by subscription and publisher
  };

  TopicRecord& record(ObjectId topic);
  static const Publication* find_untimed(Flight& flight, ObjectId subscription, std::int64_t source_timestamp);
  // Whether the message was taken already, on a machine whose clock differs.
  bool was_taken_early(TopicRecord& topic_record, Flight& flight, const Publication& publication,
                       std::int64_t source_timestamp);

  std::vector<TopicRecord> records_;
  std::vector<Flight> flights_;  // indexed as records_
};

}  // namespace tracing
