// SPDX-License-Identifier: Apache-2.0
// Expectations of the ways of messages: publish, take, callback.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/text/names.hpp"
#include "launch_trace_testing/expectations.hpp"
#include "tracing/expect/event_table.hpp"
#include "tracing/expect/verdict_text.hpp"

namespace launch_trace_testing {

namespace {

std::string describe(const Route& route) {
  std::string text = route.topic.empty() ? "of any topic" : "of topic '" + route.topic + "'";
  if (!route.publisher.empty()) {
    text += " from '" + route.publisher + "'";
  }
  if (!route.subscriber.empty()) {
    text += " to '" + route.subscriber + "'";
  }
  return text;
}

bool is_published_on(const Route& route, const Delivery& delivery) {
  return (route.topic.empty() || route.topic == delivery.topic) &&
         (route.publisher.empty() || route.publisher == delivery.publisher);
}

bool has_arrived(const Route& route, const Delivery& delivery) {
  return delivery.callback_start_ns != 0 && (route.subscriber.empty() || route.subscriber == delivery.subscriber);
}

// Of the topics of the route.
MessageDoubts doubts_of(const Trace& trace, const Route& route) {
  MessageDoubts all;
  for (const MessageDoubts& doubts : trace.doubts()) {
    if (route.topic.empty() || route.topic == doubts.topic) {
      all.estimated += doubts.estimated;
      all.taken += doubts.taken;
      all.published += doubts.published;
    }
  }
  return all;
}

// Stands behind what was seen.
std::string estimate_text(const MessageDoubts& doubts) {
  return doubts.estimated == 0 ? "" : "; an estimate, as publications have no timestamps";
}

// The trace does not tell. `text` says what was expected and seen.
Verdict undecided(const Trace& trace, const std::string& text, const MessageDoubts& doubts) {
  const std::string recorder = trace.tracetools().empty() ? "" : fmt::format(" by tracetools {}", trace.tracetools());
  std::string why;
  if (trace.lacks_middleware()) {
    why = fmt::format(
        "the trace has no rmw_publish and no rmw_take; it was recorded{}, and they are there from tracetools "
        "3.1 on",
        recorder);
  } else {
    why = fmt::format(
        "the publications of {} that {} taken can't be told; the trace was recorded{}, which gives "
        "publications no timestamps",
        counted(doubts.taken, "message"), doubts.taken == 1 ? "was" : "were", recorder);
  }
  return {.holds = false,
          .text = fmt::format("{}\n{}\nneeded: tracetools 8.0 or later (ROS 2 Jazzy)", text, why),
          .is_undecided = true};
}

std::string delivery_line(const Trace& trace, const Delivery& delivery) {
  const auto after = [&](std::int64_t time_ns) { return duration_text(time_ns - delivery.called_ns); };
  std::string line = fmt::format("\n  {}  {}  {}", relative_time(trace, delivery.called_ns), delivery.topic,
                                 delivery.publisher.empty() ? "?" : delivery.publisher);
  if (delivery.taken_ns == 0) {
    return line + (doubts_of(trace, {delivery.topic}).published > 0 ? "  not taken, as far as the trace tells"
                                                                    : "  not taken");
  }
  line += fmt::format(" -> {}  taken after {}", delivery.subscriber.empty() ? "?" : delivery.subscriber,
                      after(delivery.taken_ns));
  if (delivery.callback_start_ns == 0) {
    return line + "  no callback";
  }
  return line + fmt::format("  callback after {}", after(delivery.callback_start_ns));
}

std::string delivery_table(const Trace& trace, const std::vector<const Delivery*>& deliveries) {
  std::string text;
  for (std::size_t i = 0; i < deliveries.size() && i < kMostRows; ++i) {
    text += delivery_line(trace, *deliveries[i]);
  }
  if (deliveries.size() > kMostRows) {
    text += fmt::format("\n  ... {} more", deliveries.size() - kMostRows);
  }
  return text;
}

// What there is when nothing was published on the route.
std::string other_topics(const Trace& trace, const Route& route) {
  std::map<std::string, std::size_t> counts;
  std::vector<std::string> names;
  for (const Delivery& delivery : trace.deliveries()) {
    if (++counts[delivery.topic] == 1) {
      names.push_back(delivery.topic);
    }
  }
  const std::string nearest = launch::nearest_name(route.topic, names);
  if (!nearest.empty()) {
    return fmt::format("\nno message of this topic; did you mean '{}'?", nearest);
  }
  if (counts.empty()) {
    return "\nthe trace has no messages";
  }
  std::string text = "\nthe topics of the trace:";
  for (const auto& [name, count] : counts) {
    text += fmt::format("\n  {:>7} {}", count, name.empty() ? "?" : name);
  }
  return text;
}

}  // namespace

Verdict expect_delivered(const Trace& trace, const Route& route, Count count, Bounds latency) {
  std::vector<const Delivery*> published;
  std::vector<const Delivery*> lost;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < trace.deliveries().size(); ++i) {
    const Delivery& delivery = trace.deliveries()[i];
    if (!is_published_on(route, delivery)) {
      continue;
    }
    published.push_back(&delivery);
    if (has_arrived(route, delivery)) {
      samples.push_back({delivery.callback_start_ns - delivery.called_ns, i});
    } else {
      lost.push_back(&delivery);
    }
  }
  const MessageDoubts doubts = doubts_of(trace, route);
  const std::string messages =
      fmt::format("{} {} {} a callback", count_text(count), count.least == 1 ? "message" : "messages",
                  describe(route) + (count.least == 1 ? " reaches" : " reach"));
  if (samples.size() < count.least || samples.size() > count.most) {
    std::string text = fmt::format("expected: {}\n     saw: {} of {}{}", messages, samples.size(), published.size(),
                                   estimate_text(doubts));
    const bool may_be_enough = samples.size() < count.least && samples.size() + doubts.taken >= count.least;
    if (may_be_enough || trace.lacks_middleware()) {
      return undecided(trace, text, doubts);
    }
    if (published.empty()) {
      return {false, text + other_topics(trace, route)};
    }
    if (samples.size() < count.least) {
      return {false, text + "\nwithout a callback:" + delivery_table(trace, lost)};
    }
    std::vector<const Delivery*> arrived;
    for (const Sample& sample : samples) {
      arrived.push_back(&trace.deliveries()[sample.item]);
    }
    return {false, text + delivery_table(trace, arrived)};
  }
  if (latency.most == Bounds{}.most && latency.least == Bounds{}.least) {
    return {true, fmt::format("expected: {}\n     saw: {} of {}{}", messages, samples.size(), published.size(),
                              estimate_text(doubts))};
  }
  const std::string expected = fmt::format("{}, each after {}", messages, bounds_text(latency));
  Verdict verdict = verdict_on_samples(expected, samples, latency, [&](const std::vector<Sample>& worst) {
    std::vector<const Delivery*> rows;
    for (const Sample& sample : worst) {
      rows.push_back(&trace.deliveries()[sample.item]);
    }
    return delivery_table(trace, rows);
  });
  if (doubts.estimated > 0) {
    verdict.text += "\nestimates, as publications have no timestamps";
  }
  return verdict;
}

Verdict expect_all_delivered(const Trace& trace, const Route& route, std::size_t most_missing,
                             std::chrono::nanoseconds settling) {
  // A message that several subscriptions take is there several times.
  using Publication = std::tuple<std::int64_t, std::int64_t, std::string>;  // process, time, publisher
  std::map<Publication, std::pair<const Delivery*, bool>> publications;
  std::int64_t first_taken = 0;
  for (const Delivery& delivery : trace.deliveries()) {
    if (!is_published_on(route, delivery)) {
      continue;
    }
    const bool arrived = has_arrived(route, delivery);
    if (arrived && (first_taken == 0 || delivery.published_ns < first_taken)) {
      first_taken = delivery.published_ns;
    }
    auto& known = publications[{delivery.publisher_vpid, delivery.published_ns, delivery.publisher}];
    if (known.first == nullptr || arrived) {
      known.first = &delivery;
    }
    known.second = known.second || arrived;
  }
  const std::int64_t last = trace.end_ns() - settling.count();
  std::size_t counting = 0;
  std::vector<const Delivery*> missing;
  for (const auto& [publication, state] : publications) {
    const auto& [delivery, arrived] = state;
    if (first_taken == 0 || delivery->published_ns < first_taken || (!arrived && delivery->published_ns > last)) {
      continue;
    }
    ++counting;
    if (!arrived) {
      missing.push_back(delivery);
    }
  }
  std::string text = fmt::format("expected: all messages {} reach a callback", describe(route));
  if (most_missing > 0) {
    text += fmt::format(", but for {}", most_missing);
  }
  const MessageDoubts doubts = doubts_of(trace, route);
  if (publications.empty()) {
    text += "\n     saw: no message";
    return doubts.taken > 0 || trace.lacks_middleware() ? undecided(trace, text, doubts)
                                                        : Verdict{false, text + other_topics(trace, route)};
  }
  if (counting == 0) {
    text += fmt::format("\n     saw: none of {}", publications.size());
    return doubts.published > 0 ? undecided(trace, text, doubts) : Verdict{false, text};
  }
  text += fmt::format("\n     saw: {} of {}{}", counting - missing.size(), counting, estimate_text(doubts));
  if (missing.size() > most_missing && missing.size() <= most_missing + doubts.published) {
    return undecided(trace, text, doubts);
  }
  std::sort(missing.begin(), missing.end(),
            [](const Delivery* a, const Delivery* b) { return a->published_ns < b->published_ns; });
  if (!missing.empty()) {
    text += "\nmissing:" + delivery_table(trace, missing);
  }
  return {missing.size() <= most_missing, text};
}

}  // namespace launch_trace_testing
