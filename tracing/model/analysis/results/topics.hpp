// SPDX-License-Identifier: Apache-2.0
// Topics, and what became of the messages on them.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

struct TopicResult {
  std::string name;
  std::uint32_t publishers = 0;
  std::uint32_t subscriptions = 0;
  std::uint64_t published = 0;
  std::uint64_t received = 0;
  std::uint64_t published_only = 0;
  std::uint64_t received_only = 0;
  DurationSummary latency;
  double rate_hz = 0;
  DurationSummary interval;
  std::uint64_t intra_process_published = 0;
  std::uint64_t intra_process_received = 0;
  std::uint64_t early = 0;
  std::int64_t earliest_ns = 0;
  std::uint64_t estimated = 0;
  std::uint64_t unidentified = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unrecorded = 0;
  bool doubtful = false;

  // Part of its figures was found by the times of messages, without timestamps of publications.
  bool is_estimated() const { return estimated + unidentified + undecided > 0; }

  static const Field<TopicResult> kFields[];
};
inline constexpr Field<TopicResult> TopicResult::kFields[] = {
    {"name", &TopicResult::name, ""},
    {"publishers", &TopicResult::publishers, "objects in the trace"},
    {"subscriptions", &TopicResult::subscriptions, "likewise"},
    {"published", &TopicResult::published, "messages handed to the middleware"},
    {"received", &TopicResult::received,
     "messages taken from the middleware; each subscription counts its own, also copies of what it gets without the "
     "middleware"},
    {"published_only", &TopicResult::published_only,
     "part of `published`: messages that no subscription in the trace took"},
    {"received_only", &TopicResult::received_only, "part of `received`: messages published outside the trace"},
    {"latency", &TopicResult::latency, "from `rmw_publish` to `callback_start`, of messages with both"},
    {"rate_hz", &TopicResult::rate_hz,
     "messages in a second, of all publishers, within the process or not; 0 for a single one and for a burst"},
    {"interval", &TopicResult::interval, "from one message of a publisher to its next one"},
    {"intra_process_published", &TopicResult::intra_process_published,
     "handed to subscriptions of the publisher's process, without the middleware"},
    {"intra_process_received", &TopicResult::intra_process_received, "likewise"},
    {"early", &TopicResult::early,
     "part of `received`: taken before they were published, because the clocks of two machines differ; they have no "
     "latency"},
    {"earliest_ns", &TopicResult::earliest_ns, "how long before, at most"},
    {"estimated", &TopicResult::estimated,
     "part of `received`: the trace has no timestamps of publications (ros2_tracing before 8.0), and which one it is "
     "was found by its time (`docs/analysis.md`)"},
    {"unidentified", &TopicResult::unidentified, "part of `received`, likewise: which one it is can't be told"},
    {"undecided", &TopicResult::undecided,
     "part of `published`, likewise: whether a subscription took them can't be told"},
    {"unrecorded", &TopicResult::unrecorded, "messages that began a callback, and whose take the trace does not hold"},
    {"doubtful", &TopicResult::doubtful,
     "the process of a publisher or subscription may have lost events, or clocks differ"},
};

// What became of the messages for one subscription. The parts of the latency are explained in delivery_statistics.hpp.
struct SubscriptionResult {
  ProcessIndex process = 0;
  std::string node;
  std::string topic;
  std::uint64_t queue_depth = 0;
  std::uint64_t received = 0;
  std::uint64_t intra_process = 0;
  std::uint64_t delivered = 0;
  std::uint64_t not_executed = 0;
  std::uint64_t overwritten = 0;
  std::uint64_t overwritten_in_buffer = 0;
  std::uint64_t lost = 0;
  std::uint64_t lost_by_publisher = 0;
  std::uint64_t lost_in_transport = 0;
  std::uint64_t filtered = 0;
  std::uint64_t before_first = 0;
  std::uint64_t after_last = 0;
  DurationSummary latency;
  DurationSummary rclcpp;
  DurationSummary rcl;
  DurationSummary transport;
  DurationSummary executor;
  DurationSummary take;
  std::uint64_t estimated = 0;
  std::uint64_t unidentified = 0;
  bool doubtful = false;

  std::uint64_t lost_unplaced() const { return lost - lost_by_publisher - lost_in_transport; }
  std::uint64_t dropped() const { return not_executed + overwritten + overwritten_in_buffer + lost; }

  static const Field<SubscriptionResult> kFields[];
};
inline constexpr Field<SubscriptionResult> SubscriptionResult::kFields[] = {
    {"process", &SubscriptionResult::process, "index in `processes`", trait::kProcess},
    {"node", &SubscriptionResult::node, ""},
    {"topic", &SubscriptionResult::topic, ""},
    {"queue_depth", &SubscriptionResult::queue_depth, ""},
    {"received", &SubscriptionResult::received, ""},
    {"intra_process", &SubscriptionResult::intra_process, "part of `received`"},
    {"delivered", &SubscriptionResult::delivered,
     "to a callback, to a waitable such as an action client, or to the program that took it"},
    {"not_executed", &SubscriptionResult::not_executed, "taken, but given to no callback"},
    {"overwritten", &SubscriptionResult::overwritten, "pushed out of the queue of the subscription"},
    {"overwritten_in_buffer", &SubscriptionResult::overwritten_in_buffer,
     "pushed out of the buffer within the process"},
    {"lost", &SubscriptionResult::lost, "on the way"},
    {"lost_by_publisher", &SubscriptionResult::lost_by_publisher,
     "part of `lost`, if the trace has the quality of service: pushed out of the publisher's queue"},
    {"lost_in_transport", &SubscriptionResult::lost_in_transport, "likewise: in the network or in shared memory"},
    {"filtered", &SubscriptionResult::filtered,
     "of a subscription with a filter, if the trace has the quality of service: its filter did not let them through, "
     "or "
     "they were lost"},
    {"before_first", &SubscriptionResult::before_first, "published before the first one that came"},
    {"after_last", &SubscriptionResult::after_last, "published after the last one that came"},
    {"latency", &SubscriptionResult::latency, "from the first publish function to `callback_start`; its parts follow"},
    {"rclcpp", &SubscriptionResult::rclcpp, "`docs/report.md` explains the parts"},
    {"rcl", &SubscriptionResult::rcl, ""},
    {"transport", &SubscriptionResult::transport, "on the way"},
    {"executor", &SubscriptionResult::executor, "waiting for the executor"},
    {"take", &SubscriptionResult::take, "from the take to the callback"},
    {"estimated", &SubscriptionResult::estimated, "as of the topic: part of `received`"},
    {"unidentified", &SubscriptionResult::unidentified, "likewise; they count as neither lost nor overwritten"},
    {"doubtful", &SubscriptionResult::doubtful, "the process of either side may have lost events"},
};

// Events without the other event that belongs to them.
struct UnmatchedResult {
  std::string event;
  std::string reason;
  std::uint64_t count = 0;

  static const Field<UnmatchedResult> kFields[];
};
inline constexpr Field<UnmatchedResult> UnmatchedResult::kFields[] = {
    {"event", &UnmatchedResult::event, ""},
    {"reason", &UnmatchedResult::reason, "what is missing"},
    {"count", &UnmatchedResult::count, ""},
};

}  // namespace tracing
