// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

std::vector<UnmatchedResult> unmatched_results(const ObjectModel& model, const EventJoin& join,
                                               const DeliveryStatistics& deliveries) {
  const MessageMatcher& messages = join.messages().through_middleware();
  const MessageCounts& counts = join.messages().counts();
  const BufferRecord& buffers = join.messages().within_processes().record();
  std::uint64_t unfinished = 0;
  for (const CallbackRecord& record : join.callbacks().records()) {
    unfinished += record.unfinished;
  }
  std::uint64_t untaken = 0;
  std::uint64_t without_subscription = 0;
  std::uint64_t unpublished = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unidentified = 0;
  std::uint64_t estimated = 0;
  for (ObjectId topic = 0; topic < messages.records().size(); ++topic) {
    const TopicRecord& record = messages.records()[topic];
    (model.topics()[topic].subscriptions == 0 ? without_subscription : untaken) += record.published_only;
    unpublished += record.received_only;
    undecided += record.undecided;
    unidentified += record.unidentified;
    estimated += record.estimated;
  }
  std::uint64_t not_executed = 0;
  for (const DeliveryRecord& record : deliveries.subscriptions()) {
    not_executed += record.not_executed;
  }
  std::uint64_t unanswered = 0;
  std::uint64_t in_flight = 0;
  for (const auto& [pair, record] : join.calls().records()) {
    unanswered += record.requests - record.responses - record.in_flight;
    in_flight += record.in_flight;
  }

  std::vector<UnmatchedResult> results;
  const auto add = [&results](const char* event, const char* reason, std::uint64_t count) {
    if (count > 0) {
      results.push_back({event, reason, count});
    }
  };
  add("callback_start", "no end: an exception, a killed process, or it ran when the trace ended", unfinished);
  add("callback_end", "no begin: it ran when the trace began, or the begin was lost",
      join.callbacks().ends_without_begin());
  add("rmw_publish", "the topic has no subscription in the trace", without_subscription);
  add("rmw_publish", "no subscription took the message: not connected, ignored by those of its own process, or lost",
      untaken);
  add("rmw_publish", "it has no timestamp, as in ros2_tracing before 8.0: whether it was taken can't be told",
      undecided);
  add("rmw_publish", "it has no publisher, as in ros2_tracing before 8.0, and the trace has no rcl_publish",
      counts.unnamed);
  add("rmw_publish", "the creation of the publisher is not in the trace", counts.unknown_publications);
  add("rmw_take", "the publication is not in the trace", unpublished);
  add("rmw_take", "the publications have no timestamps: which one it is can't be told", unidentified);
  add("rmw_take", "the publications have no timestamps: which one it is was found by its time, an estimate", estimated);
  add("rmw_take", "the creation of the subscription is not in the trace", counts.unknown - counts.unknown_publications);
  add("rmw_take", "no callback got the message", not_executed);
  add("rclcpp_ring_buffer_enqueue", "a newer message took the place of this one", buffers.overwritten);
  add("rclcpp_ring_buffer_enqueue", "the buffer was cleared", buffers.cleared);
  add("rclcpp_ring_buffer_dequeue", "the message was not put in within the trace", buffers.unknown);
  add("rmw_send_request", "no response within the trace", unanswered);
  add("rmw_send_request", "in flight when the trace or the client ended", in_flight);
  add("rmw_send_request", "the creation of the client is not in the trace", join.calls().unknown_clients());
  return results;
}

}  // namespace tracing
