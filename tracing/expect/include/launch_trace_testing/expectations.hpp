// SPDX-License-Identifier: Apache-2.0
// What a trace must hold, checked without a test framework.
//
//   const Verdict verdict = expect_count(trace, event("ros2:rcl_take"), at_least(10));
//   if (!verdict) std::cerr << verdict.text;
//
// The text of a verdict says in its first line what was expected, in its second line what there is, and then shows the
// nearest events as a table. It has no newline at its end. matchers.hpp makes these functions matchers of GoogleTest.
#pragma once

#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "launch_trace_testing/event_query.hpp"
#include "launch_trace_testing/trace.hpp"

namespace launch_trace_testing {

struct Verdict {
  bool holds = false;
  std::string text;  // of a success, too: then the table shows what was found
  // The trace does not tell whether it holds, because an older version of ros2_tracing has recorded it. `holds` is
  // false.
  bool is_undecided = false;
  explicit operator bool() const { return holds; }
};

// How many.
struct Count {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};
constexpr Count exactly(std::size_t count) {
  return {count, count};
}
constexpr Count at_least(std::size_t count) {
  return {count};
}
constexpr Count at_most(std::size_t count) {
  return {0, count};
}
constexpr Count between(std::size_t least, std::size_t most) {
  return {least, most};
}

// How long. `share` of the times must be within the bounds: 1 for all of them, 0.99 for the 99th percentile.
struct Bounds {
  std::chrono::nanoseconds least{0};
  std::chrono::nanoseconds most{std::chrono::nanoseconds::max()};
  double share = 1;
};
constexpr Bounds around(std::chrono::nanoseconds expected, std::chrono::nanoseconds tolerance, double share = 1) {
  return {expected - tolerance, expected + tolerance, share};
}
constexpr Bounds at_most(std::chrono::nanoseconds most, double share = 1) {
  return {std::chrono::nanoseconds(0), most, share};
}
constexpr Bounds at_least(std::chrono::nanoseconds least, double share = 1) {
  return {least, std::chrono::nanoseconds::max(), share};
}

// Presence, number and absence (`exactly(0)`).
Verdict expect_count(const Trace& trace, const EventQuery& query, Count count);
// Every event that `all` selects has the condition. There must be one.
Verdict expect_each(const Trace& trace, const EventQuery& all, const EventQuery& required);
// The names of all events, of those that match `among`, are exactly these.
Verdict expect_event_names(const Trace& trace, const std::vector<std::string>& names, const std::string& among = "*");
// There are events of each of these processes, named as in EventQuery::in_process().
Verdict expect_processes(const Trace& trace, const std::vector<std::string>& names);

// An event of each query, each later in the trace than the one before. Not between processes of different machines,
// whose clocks differ.
Verdict expect_order(const Trace& trace, const std::vector<EventQuery>& queries);
// The events are in the order of time.
Verdict expect_sorted(const Trace& trace, const std::vector<const Event*>& events);
// Each `effect` follows from some `cause`: a way leads from there through threads, messages and requests. Whatever the
// clocks say, it can't have happened before. There must be an effect. Threads of one process are not tied together by
// anything else that a trace tells, so nothing is said of them.
Verdict expect_happens_before(const Trace& trace, const EventQuery& cause, const EventQuery& effect);
// The value of this field is in an event of `other`, too (under the name `other_field`; empty: the same name).
Verdict expect_matching_field(const Trace& trace, const Event& event, const std::string& field, const EventQuery& other,
                              const std::string& other_field = {});

// Field is of one of the types of ros2_tracing: a handle or another pointer (not null unless allowed), a text that is
// not empty, and so on.
enum class FieldKind { kHandle, kPointer, kPointerOrNull, kText, kNonEmptyText, kInteger, kQueueDepth, kReal, kArray };
// For arrays `length` is the number of elements, if given.
Verdict expect_field(const Trace& trace, const EventQuery& query, const std::string& field, FieldKind kind,
                     std::optional<std::size_t> length = {});

// Which messages: of a topic, from and to these nodes; empty: any. Names are full ("/ns/name").
struct Route {
  std::string topic;
  std::string publisher = {};
  std::string subscriber = {};
};
// publish → take → callback: so many messages have gone the whole way, and the time from publish() to the begin of
// their callbacks is within the bounds.
Verdict expect_delivered(const Trace& trace, const Route& route, Count count, Bounds latency = {});
// Every publication has begun a callback, but for `most_missing` of them; there must be one. Messages that were
// published before the first one was taken, or in the last `settling` of the trace, do not count.
Verdict expect_all_delivered(const Trace& trace, const Route& route, std::size_t most_missing = 0,
                             std::chrono::nanoseconds settling = std::chrono::milliseconds(100));

// Which callbacks: empty members accept any. `symbol` is a part of the function's name.
struct CallbackChoice {
  std::string node = {};
  std::string topic = {};
  std::string service = {};
  std::string symbol = {};
  bool timers_only = false;
};
// There are such callbacks, and they take so long. Unfinished runs do not count.
Verdict expect_callback_duration(const Trace& trace, const CallbackChoice& callbacks, Bounds duration);
// From the begin of a callback to the next begin.
Verdict expect_callback_period(const Trace& trace, const CallbackChoice& callbacks, Bounds period);
// From an event to the next one. There must be two.
Verdict expect_period(const Trace& trace, const EventQuery& query, Bounds period);
// From each event `begin` to the next event `end` of its thread. There must be one.
Verdict expect_duration(const Trace& trace, const EventQuery& begin, const EventQuery& end, Bounds duration);

// No event was lost, and nothing is damaged. There must be an event.
Verdict expect_no_loss(const Trace& trace);

}  // namespace launch_trace_testing
