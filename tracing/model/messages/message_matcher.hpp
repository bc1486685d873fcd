// SPDX-License-Identifier: Apache-2.0
// Follows messages from the publisher to the callback that gets them, by topic and source timestamp.
//
// ros2_tracing before 8.0 records no timestamp of a publication. Middleware that records dds:write tells it then.
// Otherwise it is found when the first message of it is taken (untimed_publications.hpp), which is marked as an
// estimate.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/messages/recent_publications.hpp"
#include "tracing/model/messages/untimed_publications.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// A message that a thread has taken and not yet given to a callback.
struct TakenMessage {
  ObjectId subscription = kNoObject;
  Publication publication;  // has no publisher when it was not seen; its topic is always known
  std::int64_t taken_ns = 0;
  // As those of MessageFlow.
  bool is_estimated = false;
  bool is_unidentified = false;

  bool publication_is_known() const { return publication.publisher != kNoObject; }
};

struct TopicRecord {
  std::uint64_t published = 0;
  std::uint64_t received = 0;
  std::uint64_t published_only = 0;
  std::uint64_t received_only = 0;
  // Of a topic with publications without a timestamp:
  std::uint64_t estimated = 0;     // part of received: the publication was found by its time
  std::uint64_t unidentified = 0;  // part of received: no publication, or several, may be it
  std::uint64_t undecided = 0;     // part of published, known at the end: it is not known who took them
  std::uint64_t unrecorded =
      0;                    // messages that reached a callback, and whose take the trace does not hold; of any topic
  std::uint64_t early = 0;  // part of received: taken before the publication, which clocks that differ make of it
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

  // As SourceClocks::compare_by().
  void compare_clocks_by(std::function<bool(ProcessId, ProcessId)> have_one_clock) {
    clocks_.compare_by(std::move(have_one_clock));
  }
  // `source_timestamp`: 0 when the trace doesn't hold it.
  void publish(const Publication& publication, std::int64_t source_timestamp);
  // The middleware has written the publication, with this timestamp.
  void write(ObjectId topic, std::uint64_t number, std::int64_t source_timestamp, std::int64_t written_ns);
  TakenMessage take(ObjectId subscription, ObjectId topic, std::int64_t source_timestamp, std::int64_t time_ns,
                    ProcessId taking_process = kNoProcess);
  // The thread of a publication without a timestamp goes on.
  void close(const Publication& publication, std::int64_t time_ns);
  // A callback gets a message whose take is not in the trace.
  void deliver_unrecorded(ObjectId topic) { ++record(topic).unrecorded; }
  // `message` reaches its callback.
  void deliver(const TakenMessage& message, std::int64_t callback_start_ns);
  // To be called at the end of the trace: a message that has not been received by now never will be. `has_others` says
  // whether a topic has subscriptions beside those that have taken something, of which the trace may not hold it.
  using Takers = std::set<ObjectId>;
  void finish(const std::function<bool(ObjectId topic, const Takers& takers)>& has_others = {});

  // Indexed by the topic's ObjectId; may be shorter than the model's list.
  const std::vector<TopicRecord>& records() const { return records_; }

 private:
  // Of a topic with publications without a timestamp.
  struct Untimed {
    UntimedPublications publications{kRemembered};
    Takers takers;
    std::deque<std::int64_t> unidentified;  // source timestamps of the newest messages without a publication
    std::uint64_t unidentified_count = 0;   // messages; one that several subscriptions take counts once
  };
  // Two publishers of a topic with the same nanosecond would count as one: the trace can't tell them apart.
  struct Flight {
    RecentPublications recent{kRemembered};
    // The newest messages that were taken without a publication: source timestamp, time.
    std::deque<std::pair<std::int64_t, std::int64_t>> unknown;
    std::unique_ptr<Untimed> untimed;
  };

  TopicRecord& record(ObjectId topic);
  void add_timed(TopicRecord& topic_record, Flight& flight, const RecentPublication& publication);
  // Finds the publication by its time.
  void estimate(TopicRecord& topic_record, Flight& flight, TakenMessage& message, const SourceStamp& stamp);
  // Whether the message was taken already, on a machine whose clock differs.
  bool was_taken_early(TopicRecord& topic_record, Flight& flight, const Publication& publication,
                       std::int64_t source_timestamp);

  std::vector<TopicRecord> records_;
  std::vector<Flight> flights_;  // indexed as records_
  SourceClocks clocks_;
};

}  // namespace tracing
