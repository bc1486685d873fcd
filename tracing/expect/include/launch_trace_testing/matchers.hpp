// SPDX-License-Identifier: Apache-2.0
// Expectations on traces as matchers of GoogleTest (gMock), and fields of events for its own matchers.
//
//   EXPECT_THAT(trace, HasEvents(event("ros2:rcl_publisher_init").with("topic_name", "/ping"), exactly(1)));
//   EXPECT_THAT(trace, HasNoEvent(event("ros2:rcl_lifecycle_transition")));
//   EXPECT_THAT(trace, Delivers({.topic = "/ping"}, at_least(10), at_most(5ms, 0.99)));
//   EXPECT_THAT(*init, AllOf(Field("queue_depth", Gt(5)), TextField("topic_name", StartsWith("/p"))));
//
// Needs GoogleTest 1.11 or later. expectations.hpp describes what each matcher means.
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "launch_trace_testing/expectations.hpp"

namespace launch_trace_testing {

// Matches a trace for which the expectation holds.
class VerdictMatcher : public ::testing::MatcherInterface<const Trace&> {
 public:
  using Check = std::function<Verdict(const Trace&)>;
  explicit VerdictMatcher(Check check) : check_(std::move(check)) {}

  bool MatchAndExplain(const Trace& trace, ::testing::MatchResultListener* listener) const override {
    const Verdict verdict = check_(trace);
    const std::size_t seen = verdict.text.find(kSeen);
    if (seen != std::string::npos) {
      *listener << verdict.text.substr(seen);
    }
    return verdict.holds;
  }
  void DescribeTo(std::ostream* stream) const override { *stream << description(); }
  void DescribeNegationTo(std::ostream* stream) const override { *stream << "not: " << description(); }

 private:
  static constexpr const char* kSeen = "\n     saw:";

  // The first line of every verdict says what is expected.
  std::string description() const {
    constexpr std::string_view kExpected = "expected: ";
    const std::string text = check_(Trace()).text;
    return text.substr(kExpected.size(), text.find(kSeen) - kExpected.size());
  }

  Check check_;
};

using TraceMatcher = ::testing::Matcher<const Trace&>;

inline TraceMatcher holds(VerdictMatcher::Check check) {
  return ::testing::MakeMatcher(new VerdictMatcher(std::move(check)));
}

inline TraceMatcher HasEvents(EventQuery query, Count count = at_least(1)) {
  return holds([=](const Trace& trace) { return expect_count(trace, query, count); });
}
inline TraceMatcher HasEvent(EventQuery query) {
  return HasEvents(std::move(query));
}
inline TraceMatcher HasNoEvent(EventQuery query) {
  return HasEvents(std::move(query), exactly(0));
}
inline TraceMatcher EachEvent(EventQuery all, EventQuery required) {
  return holds([=](const Trace& trace) { return expect_each(trace, all, required); });
}
inline TraceMatcher HasFieldOfKind(EventQuery query, std::string field, FieldKind kind,
                                   std::optional<std::size_t> length = {}) {
  return holds([=](const Trace& trace) { return expect_field(trace, query, field, kind, length); });
}
inline TraceMatcher HasExactlyEventNames(std::vector<std::string> names, std::string among = "*") {
  return holds([=](const Trace& trace) { return expect_event_names(trace, names, among); });
}
inline TraceMatcher HasProcesses(std::vector<std::string> names) {
  return holds([=](const Trace& trace) { return expect_processes(trace, names); });
}
inline TraceMatcher HasEventsInOrder(std::vector<EventQuery> queries) {
  return holds([=](const Trace& trace) { return expect_order(trace, queries); });
}
inline TraceMatcher HappensBefore(EventQuery cause, EventQuery effect) {
  return holds([=](const Trace& trace) { return expect_happens_before(trace, cause, effect); });
}
// `event` must be of the trace, and the trace must outlive the matcher.
inline TraceMatcher HasMatchingField(const Event& event, std::string field, EventQuery other,
                                     std::string other_field = {}) {
  return holds(
      [=, &event](const Trace& trace) { return expect_matching_field(trace, event, field, other, other_field); });
}
inline TraceMatcher Delivers(Route route, Count count = at_least(1), Bounds latency = {}) {
  return holds([=](const Trace& trace) { return expect_delivered(trace, route, count, latency); });
}
inline TraceMatcher DeliversAll(Route route, std::size_t most_missing = 0,
                                std::chrono::nanoseconds settling = std::chrono::milliseconds(100)) {
  return holds([=](const Trace& trace) { return expect_all_delivered(trace, route, most_missing, settling); });
}
inline TraceMatcher CallbackTakes(CallbackChoice callbacks, Bounds duration) {
  return holds([=](const Trace& trace) { return expect_callback_duration(trace, callbacks, duration); });
}
inline TraceMatcher CallbackHasPeriod(CallbackChoice callbacks, Bounds period) {
  return holds([=](const Trace& trace) { return expect_callback_period(trace, callbacks, period); });
}
inline TraceMatcher HasPeriod(EventQuery query, Bounds period) {
  return holds([=](const Trace& trace) { return expect_period(trace, query, period); });
}
inline TraceMatcher HasDuration(EventQuery begin, EventQuery end, Bounds duration) {
  return holds([=](const Trace& trace) { return expect_duration(trace, begin, end, duration); });
}
inline TraceMatcher LostNothing() {
  return holds([](const Trace& trace) { return expect_no_loss(trace); });
}

// An event whose field has a value that `read` makes of it, and that matches.
template <class Read, class Matcher>
::testing::Matcher<const Event&> FieldThat(std::string name, Read read, Matcher matcher) {
  using Read_ = typename decltype(read(std::declval<const Value&>()))::value_type;
  return ::testing::ResultOf(
      "field " + name,
      [name, read](const Event& event) {
        const Value* const value = event.find(name);
        return value == nullptr ? std::nullopt : read(*value);
      },
      ::testing::Optional(::testing::SafeMatcherCast<const Read_&>(matcher)));
}
// An event whose field, a number, matches: Field("queue_depth", Gt(5)). A number that does not fit, and a text, do not
// match.
template <class Matcher>
::testing::Matcher<const Event&> Field(std::string name, Matcher matcher) {
  return FieldThat(
      std::move(name), [](const Value& value) { return value.integer(); }, matcher);
}
// The same for a pointer or another unsigned number, for a text, and for a name.
template <class Matcher>
::testing::Matcher<const Event&> HandleField(std::string name, Matcher matcher) {
  return FieldThat(
      std::move(name), [](const Value& value) { return value.unsigned_integer(); }, matcher);
}
template <class Matcher>
::testing::Matcher<const Event&> TextField(std::string name, Matcher matcher) {
  return FieldThat(
      std::move(name),
      [](const Value& value) {
        const auto text = value.text();
        return text ? std::optional<std::string>(*text) : std::nullopt;
      },
      matcher);
}
template <class Matcher>
::testing::Matcher<const Event&> Named(Matcher matcher) {
  return ::testing::Property("name", &Event::name, matcher);
}

// A query with a matcher of events: event_that("ros2:rcl_publisher_init", Field("queue_depth", Gt(5))).
inline EventQuery event_that(std::string name, ::testing::Matcher<const Event&> matcher) {
  std::string description = ::testing::DescribeMatcher<const Event&>(matcher);
  return event(std::move(name)).that(std::move(description), [matcher](const Event& event) {
    return matcher.Matches(event);
  });
}

}  // namespace launch_trace_testing
