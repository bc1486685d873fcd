// SPDX-License-Identifier: Apache-2.0
// Expectations of the order of events in a trace.
#include <fmt/format.h>

#include <algorithm>

#include "launch_trace_testing/expectations.hpp"
#include "tracing/expect/event_table.hpp"

namespace launch_trace_testing {

Verdict expect_order(const Trace& trace, const std::vector<EventQuery>& queries) {
  std::string expected = "expected: in this order:";
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    expected += fmt::format("\n  {}. {}", i + 1, queries[i].describe());
    for (const std::string& field : fields_of(queries[i])) {
      if (std::find(fields.begin(), fields.end(), field) == fields.end()) {
        fields.push_back(field);
      }
    }
  }
  std::vector<TableRow> found;
  auto at = trace.begin();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const EventQuery& query = queries[i];
    const auto next = std::find_if(at, trace.end(), [&](const Event& event) { return query.matches(event); });
    if (next != trace.end()) {
      found.push_back({&*next, fmt::format("{}.", i + 1)});
      at = next + 1;
      continue;
    }
    std::string text = fmt::format("{}\n     saw: ", expected);
    text += found.empty() ? "no event for 1." : fmt::format("no event for {}. behind this one for {}.", i + 1, i);
    if (!found.empty()) {
      text += event_table(trace, found, fields);
    }
    std::vector<TableRow> earlier;
    for (const Event* const event : query.select(trace)) {
      earlier.push_back({event, fmt::format("{}.", i + 1)});
    }
    if (earlier.empty()) {
      return {false, text + nearest_text(trace, query)};
    }
    return {false, text + "\nearlier events:" + event_table(trace, earlier, fields)};
  }
  return {true, expected + "\n     saw:" + event_table(trace, found, fields)};
}

Verdict expect_sorted(const Trace& trace, const std::vector<const Event*>& events) {
  const std::string expected = fmt::format("expected: {} in the order of time", counted(events.size(), "event"));
  for (std::size_t i = 1; i < events.size(); ++i) {
    if (events[i - 1]->position() < events[i]->position()) {
      continue;
    }
    return {false, fmt::format("{}\n     saw: event {} is not behind event {}{}", expected, i + 1, i,
                               event_table(trace, {{events[i - 1], fmt::format("{}.", i)},
                                                   {events[i], fmt::format("{}.", i + 1)}}))};
  }
  return {true, expected + "\n     saw: this order"};
}

}  // namespace launch_trace_testing
