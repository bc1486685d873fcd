// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracing/model/findings/finders.hpp"
#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"

namespace tracing {

namespace {

constexpr std::int64_t kLongWait = 1'000'000;

// "/scan to left: /planner"
std::string label(const Hosts& hosts, const SubscriptionResult& subscription) {
  return fmt::format("{} to {}{}", subscription.topic, hosts.before(subscription.process),
                     subscription.node.empty() ? "?" : subscription.node);
}

// What helps where most were lost.
std::string remedy(const SubscriptionResult& subscription, const CallbackResult* callback) {
  const std::pair<std::uint64_t, std::string> remedies[] = {
      {subscription.overwritten + subscription.overwritten_in_buffer,
       fmt::format("a longer queue than {}, or shorter callbacks in its thread", subscription.queue_depth)},
      {subscription.lost_by_publisher, "a longer queue of the publisher"},
      {subscription.lost_in_transport, "make both sides reliable, or raise net.core.rmem_max"},
      {subscription.lost_unplaced(), "record ros2_ext:*, which tells where they got lost"},
      {subscription.not_executed, "look for exceptions in the output of its process"},
  };
  const auto& most = *std::max_element(std::begin(remedies), std::end(remedies),
                                       [](const auto& a, const auto& b) { return a.first < b.first; });
  return callback == nullptr || callback->symbol.empty() ? most.second : most.second + "; " + callback->brief_symbol();
}

}  // namespace

Findings dropped_messages(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    const std::uint64_t dropped = subscription.dropped();
    if (dropped == 0) {
      continue;
    }
    const std::uint64_t sent = subscription.delivered + dropped;
    std::string places;
    const auto place = [&places](std::uint64_t count, const char* where) {
      if (count > 0) {
        places += fmt::format("{}{} {}", places.empty() ? "" : ", ", count, where);
      }
    };
    place(subscription.overwritten, "pushed out of its queue");
    place(subscription.overwritten_in_buffer, "pushed out of its buffer");
    place(subscription.lost_by_publisher, "lost by the publisher");
    place(subscription.lost_in_transport, "lost in transport");
    place(subscription.lost_unplaced(), "lost on the way");
    place(subscription.not_executed, "not executed");
    // The part counts, and the number where parts are equal.
    const double share = std::min(1.0, static_cast<double>(dropped) * 4 / static_cast<double>(sent));
    const double weight = 55 + 39 * share + std::min(1.0, std::log10(static_cast<double>(dropped)) / 10);
    findings.push_back(
        {Finding::Kind::kDroppedMessages,
         weight,
         label(hosts, subscription),
         fmt::format("{} of {}: {}{}", dropped, sent, places, mark(subscription.doubtful, subscription.estimated > 0)),
         remedy(subscription, callback_of(results, subscription)),
         {},
         subscription.topic});
  }
  return findings;
}

Findings waiting_messages(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const SubscriptionResult& subscription : results.ros2.subscriptions) {
    const std::int64_t wait_ns = usual_worst(subscription.executor);
    if (subscription.executor.count == 0 || wait_ns < kLongWait) {
      continue;
    }
    const double share = static_cast<double>(wait_ns) /
                         static_cast<double>(std::max<std::int64_t>(usual_worst(subscription.latency), 1));
    const double milliseconds = static_cast<double>(wait_ns) / 1e6;
    const CallbackResult* const callback = callback_of(results, subscription);
    Finding finding{
        Finding::Kind::kLongestWait,
        25 + 25 * std::min(1.0, share) + std::min(20.0, 5 * std::log10(1 + milliseconds)),
        label(hosts, subscription),
        fmt::format("messages wait {} for a busy executor, at p99 {} of {} in all{}",
                    duration(subscription.executor.p50_ns), duration(subscription.executor.p99_ns),
                    duration(subscription.latency.p99_ns), mark(subscription.doubtful, subscription.estimated > 0)),
        callback == nullptr || callback->held_up_by.empty()
            ? "launch report DIR --html FILE shows what its thread does meanwhile"
            : fmt::format("mostly for {}: give one of them an executor of its own", callback->held_up_by),
        {},
        subscription.topic};
    if (callback != nullptr) {
      finding.callback = callback->id;
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

Findings unanswered_requests(const TraceResults& results) {
  const Hosts hosts(results.overview);
  Findings findings;
  for (const CallResult& call : results.ros2.calls) {
    const std::uint64_t open = call.unanswered();
    if (open == 0) {
      continue;
    }
    findings.push_back(
        {Finding::Kind::kUnanswered, 40 + 40 * static_cast<double>(open) / static_cast<double>(call.requests),
         call.service,
         fmt::format("{} of {} from {}{} got no response", open, format_count(call.requests, "request"),
                     hosts.before(call.client_process), call.client.empty() ? "?" : call.client),
         call.server.empty()
             ? "no service took them: let the client wait for the service"
             : fmt::format("does the callback of {} answer each request, and does the client spin?", call.server)});
  }
  return findings;
}

}  // namespace tracing
