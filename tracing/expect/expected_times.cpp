// SPDX-License-Identifier: Apache-2.0
// Expectations of periods and durations, of events and of callbacks.
#include <fmt/format.h>

#include <map>
#include <tuple>

#include "launch_trace_testing/expectations.hpp"
#include "tracing/expect/event_table.hpp"
#include "tracing/expect/verdict_text.hpp"

namespace launch_trace_testing {

namespace {

bool is_chosen(const CallbackChoice& choice, const CallbackRun& run) {
  return (choice.node.empty() || choice.node == run.node) && (choice.topic.empty() || choice.topic == run.topic) &&
         (choice.service.empty() || choice.service == run.service) &&
         (choice.symbol.empty() || run.symbol.find(choice.symbol) != std::string::npos) &&
         (!choice.timers_only || run.is_timer);
}

std::string describe(const CallbackChoice& choice) {
  std::string text = choice.timers_only ? "timer callback" : "callback";
  if (!choice.node.empty()) {
    text += " of node '" + choice.node + "'";
  }
  if (!choice.topic.empty()) {
    text += " of topic '" + choice.topic + "'";
  }
  if (!choice.service.empty()) {
    text += " of service '" + choice.service + "'";
  }
  if (!choice.symbol.empty()) {
    text += " with '" + choice.symbol + "' in its name";
  }
  return text;
}

std::string identity(const CallbackRun& run) {
  std::string text = run.node.empty() ? "?" : run.node;
  if (!run.topic.empty()) {
    text += " topic " + run.topic;
  }
  if (!run.service.empty()) {
    text += " service " + run.service;
  }
  if (run.is_timer) {
    text += " timer of " + duration_text(run.period_ns);
  }
  if (!run.symbol.empty()) {
    text += " " + run.symbol;
  }
  return text;
}

std::string other_callbacks(const Trace& trace) {
  std::map<std::string, std::size_t> counts;
  for (const CallbackRun& run : trace.callbacks()) {
    ++counts[identity(run)];
  }
  if (counts.empty()) {
    return "\nthe trace has no callbacks";
  }
  std::string text = "\nthe callbacks of the trace:";
  for (const auto& [name, count] : counts) {
    text += fmt::format("\n  {:>7} {}", count, name);
  }
  return text;
}

std::string callback_table(const Trace& trace, const std::vector<Sample>& samples) {
  std::string text;
  for (const Sample& sample : samples) {
    const CallbackRun& run = trace.callbacks()[sample.item];
    text +=
        fmt::format("\n  {}  {:>12}  {}", relative_time(trace, run.start_ns), duration_text(sample.ns), identity(run));
  }
  return text;
}

Verdict verdict_on_callbacks(const Trace& trace, const std::string& expected, const std::vector<Sample>& samples,
                             Bounds bounds) {
  Verdict verdict = verdict_on_samples(expected, samples, bounds,
                                       [&](const std::vector<Sample>& worst) { return callback_table(trace, worst); });
  if (samples.empty()) {
    verdict.text += other_callbacks(trace);
  }
  return verdict;
}

std::string event_rows(const Trace& trace, const std::vector<Sample>& samples, const std::vector<std::string>& fields) {
  std::vector<TableRow> rows;
  for (const Sample& sample : samples) {
    rows.push_back({&trace.events()[sample.item], "[" + duration_text(sample.ns) + "]"});
  }
  return event_table(trace, rows, fields);
}

}  // namespace

Verdict expect_callback_duration(const Trace& trace, const CallbackChoice& callbacks, Bounds duration) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < trace.callbacks().size(); ++i) {
    const CallbackRun& run = trace.callbacks()[i];
    if (run.finished && is_chosen(callbacks, run)) {
      samples.push_back({run.end_ns - run.start_ns, i});
    }
  }
  const std::string expected = fmt::format("each {} takes {}", describe(callbacks), bounds_text(duration));
  return verdict_on_callbacks(trace, expected, samples, duration);
}

Verdict expect_callback_period(const Trace& trace, const CallbackChoice& callbacks, Bounds period) {
  std::map<std::tuple<std::int64_t, std::string>, std::int64_t> last_starts;
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < trace.callbacks().size(); ++i) {
    const CallbackRun& run = trace.callbacks()[i];
    if (!is_chosen(callbacks, run)) {
      continue;
    }
    const auto [last, is_first] = last_starts.try_emplace({run.vpid, identity(run)}, run.start_ns);
    if (!is_first) {
      samples.push_back({run.start_ns - last->second, i});
    }
    last->second = run.start_ns;
  }
  const std::string expected = fmt::format("from each {} to the next one {}", describe(callbacks), bounds_text(period));
  return verdict_on_callbacks(trace, expected, samples, period);
}

Verdict expect_period(const Trace& trace, const EventQuery& query, Bounds period) {
  const std::vector<const Event*> events = query.select(trace);
  std::vector<Sample> samples;
  for (std::size_t i = 1; i < events.size(); ++i) {
    samples.push_back({events[i]->time_ns() - events[i - 1]->time_ns(), events[i]->position()});
  }
  const std::string expected = fmt::format("from each {} to the next one {}", query.describe(), bounds_text(period));
  Verdict verdict = verdict_on_samples(expected, samples, period, [&](const std::vector<Sample>& worst) {
    return event_rows(trace, worst, fields_of(query));
  });
  if (events.empty()) {
    verdict.text += nearest_text(trace, query);
  }
  if (events.size() == 1) {
    verdict.text += event_table(trace, {{events.front(), "[the only one]"}}, fields_of(query));
  }
  return verdict;
}

Verdict expect_duration(const Trace& trace, const EventQuery& begin, const EventQuery& end, Bounds duration) {
  using Thread = std::tuple<std::string, std::int64_t, std::int64_t>;
  std::map<Thread, const Event*> begun;
  std::vector<Sample> samples;
  for (const Event& event : trace) {
    const Thread thread{event.host(), event.vpid(), event.vtid()};
    if (const auto open = begun.find(thread); open != begun.end() && end.matches(event)) {
      samples.push_back({event.time_ns() - open->second->time_ns(), open->second->position()});
      begun.erase(open);
    }
    if (begin.matches(event)) {
      begun.try_emplace(thread, &event);
    }
  }
  const std::string expected = fmt::format("from each {} to the next {} of its thread {}", begin.describe(),
                                           end.describe(), bounds_text(duration));
  Verdict verdict = verdict_on_samples(expected, samples, duration, [&](const std::vector<Sample>& worst) {
    return event_rows(trace, worst, fields_of(begin));
  });
  if (samples.empty()) {
    verdict.text += nearest_text(trace, begin.first(trace) == nullptr ? begin : end);
  }
  return verdict;
}

}  // namespace launch_trace_testing
