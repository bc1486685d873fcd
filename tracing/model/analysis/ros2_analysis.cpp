// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/ros2_analysis.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "tracing/model/analysis/derived_results.hpp"
#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

Ros2Analysis::Ros2Analysis(ExecutionSink* sink, std::vector<ChainDefinition> chains)
    : sinks_(timing_, hold_ups_, deliveries_, executors_, chains_, allocations_, first_activity_, sink) {
  chains_.define(model_, std::move(chains));
}

void Ros2Analysis::on_caret_event(const Origin& origin, const ros2::CaretEvent& event) {
  if (event.kind == ros2::CaretEvent::Kind::kSourceTimestamp) {
    on_write(origin, event.number);
  } else {
    groups_.on(origin, event);
  }
}

namespace {

// A version of tracetools is "6.3.2".
bool is_older(const Ros2Results& results) {
  const auto is_old = [](const std::string& version) {
    int major = 0;
    const auto [end, error] = std::from_chars(version.data(), version.data() + version.size(), major);
    return error == std::errc() && major < 8;
  };
  return std::any_of(results.tracetools.begin(), results.tracetools.end(), is_old) ||
         std::any_of(results.topics.begin(), results.topics.end(),
                     [](const TopicResult& topic) { return topic.is_estimated(); });
}

}  // namespace

Ros2Results Ros2Analysis::finish(std::vector<std::optional<ProcessIndex>> places,
                                 const std::vector<ProcessResult>& processes) {
  join_.finish();
  deliveries_.finish();
  chains_.finish();

  const Subjects subjects(model_, std::move(places), processes, join_.last_ns());
  Ros2Results results;
  results.callbacks = callback_results(subjects, join_.callbacks(), timing_, hold_ups_);
  results.topics = topic_results(subjects, join_.messages().through_middleware(), deliveries_);
  results.subscriptions = subscription_results(subjects, deliveries_, join_.messages().within_processes());
  results.calls = call_results(subjects, join_.calls());
  results.actions = action_results(results);
  results.executions = execution_results(subjects, join_.executions());
  results.executors = executor_results(subjects, executors_);
  add_chain_results(subjects, chains_, join_.messages().through_middleware(), results);
  results.lifecycle = lifecycle_results(subjects, join_.lifecycle(), allocations_);
  results.nodes = node_results(subjects, results.callbacks);
  results.unmatched = unmatched_results(model_, join_, deliveries_);
  results.internal_messages = join_.messages().counts().internal;
  results.unknown_messages = join_.messages().counts().unknown;
  results.unknown_in_whole = join_.messages().counts().unknown_in_whole;
  results.tracetools.assign(join_.messages().versions().begin(), join_.messages().versions().end());
  results.unnamed_messages = join_.messages().counts().unnamed;
  results.logs = join_.messages().counts().logs;
  results.is_older = is_older(results);
  results.lacks_middleware = join_.messages().lacks_middleware();
  results.remarks = recording_remarks(results);
  return results;
}

std::vector<std::uint64_t> Ros2Analysis::missed_periods() const {
  std::vector<std::uint64_t> missed;
  for (const CallbackTimingRecord& record : timing_.records()) {
    missed.push_back(record.missed);
  }
  return missed;
}

std::vector<std::uint64_t> Ros2Analysis::dropped_messages() const {
  std::vector<std::uint64_t> dropped;
  for (const DeliveryRecord& record : deliveries_.subscriptions()) {
    dropped.push_back(record.dropped());
  }
  for (const auto& [subscription, count] : join_.messages().within_processes().overwritten()) {
    if (subscription < dropped.size()) {
      dropped[subscription] += count;
    }
  }
  return dropped;
}

std::uint64_t Ros2Analysis::dropped_messages(ObjectId subscription) const {
  const auto& records = deliveries_.subscriptions();
  return (subscription < records.size() ? records[subscription].dropped() : 0) +
         join_.messages().within_processes().overwritten_of(subscription);
}

}  // namespace tracing
