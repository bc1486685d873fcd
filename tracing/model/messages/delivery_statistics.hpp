// SPDX-License-Identifier: Apache-2.0
// What becomes of the messages for each subscription: where their time goes, and where they get lost.
//
// The time from the first publish function to the callback has five parts. The trace does not hold when a message
// reaches the subscription, so the time between rmw_publish and rmw_take is divided by what the executor's thread did:
// while it waits for work it waits for the message, which is on its way; the rest of the time the message waits for the
// executor.
#pragma once

#include <cstdint>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

struct DeliveryRecord {
  std::uint64_t received = 0;
  std::uint64_t intra_process = 0;  // part of received: without the middleware
  std::uint64_t delivered = 0;      // to a callback, a waitable, or the program that took it
  std::uint64_t not_executed = 0;   // taken, but given to no callback
  // Parts of received, of topics whose publications have no timestamps:
  std::uint64_t estimated = 0;     // which publication it is was found by its time
  std::uint64_t unidentified = 0;  // that could not be found

  // Messages of publishers from which the subscription also got others.
  std::uint64_t overwritten = 0;  // pushed out of the full history of the reader by newer messages
  std::uint64_t lost = 0;         // on the way: in the history of the writer, or in the network
  // Instead of these, if the subscription has a filter: most were not meant to come, and nothing tells the others
  // apart.
  std::uint64_t filtered = 0;
  // Parts of lost, if the trace has the quality of service of both sides. Reliable messages are repeated until they
  // arrive, unless the writer has replaced them in its history.
  std::uint64_t lost_by_publisher = 0;  // both sides are reliable
  std::uint64_t lost_in_transport = 0;  // one of them is not: in the network, or in the shared memory
  std::uint64_t before_first = 0;       // published before the first message that came: not connected yet
  std::uint64_t after_last = 0;  // published after the last message that came: on the way, or not connected any more

  DurationStatistics latency;  // from the first publish function in the trace to the begin of the callback
  DurationStatistics rclcpp;   // rclcpp_publish to rcl_publish
  DurationStatistics rcl;      // rcl_publish to rmw_publish
  DurationStatistics transport;
  DurationStatistics executor;
  DurationStatistics take;  // rmw_take to the callback

  // Messages that it missed.
  std::uint64_t dropped() const { return not_executed + overwritten + lost; }
};

struct PublisherRecord {
  std::uint64_t published = 0;
  std::uint64_t intra_process = 0;  // these are not part of published
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  DurationStatistics intervals;
};

class DeliveryStatistics : public ExecutionSink {
 public:
  // The model must outlive this object.
  explicit DeliveryStatistics(const ObjectModel& model) : model_(model) {}

  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& message) override;
  void finish();

  // Indexed by ObjectId of subscriptions and publishers; may be shorter than the model's lists.
  const std::vector<DeliveryRecord>& subscriptions() const { return subscriptions_; }
  const std::vector<PublisherRecord>& publishers() const { return publishers_; }

 private:
  // A message is told from the other messages of its publisher by its place among them, counted from 1.
  struct Sent {
    std::uint64_t number = 0;       // Publication::number
    std::uint64_t topic_count = 0;  // how many messages the topic had then, with this one
  };
  struct Publisher {
    std::uint64_t count = 0;
    std::deque<Sent> newest;  // the last ones; the very last one has place `count`
  };

  bool is_second_copy(const MessageFlow& message) const;
  // Where the subscription is among the messages of a publisher.
  struct Progress {
    std::uint64_t place = 0;         // of the last message that it got
    std::uint64_t unidentified = 0;  // DeliveryRecord::unidentified then
  };
  void find_gaps(const MessageFlow& message);
  void count_lost(DeliveryRecord& record, const MessageFlow& message, std::uint64_t count) const;

  const ObjectModel& model_;
  std::vector<DeliveryRecord> subscriptions_;
  std::vector<PublisherRecord> publishers_;
  std::vector<Publisher> sent_;              // by publisher, through the middleware
  std::vector<std::uint64_t> topic_counts_;  // by topic, through the middleware
  struct HashPair {
    std::size_t operator()(const std::pair<ObjectId, ObjectId>& pair) const {
      return (static_cast<std::size_t>(pair.first) << 32 | pair.second) * 0x9e3779b97f4a7c15;
    }
  };
  // By subscription and publisher.
  std::unordered_map<std::pair<ObjectId, ObjectId>, Progress, HashPair> progress_;
  bool tells_intra_process_ = false;  // the trace has rclcpp_intra_publish
};

}  // namespace tracing
