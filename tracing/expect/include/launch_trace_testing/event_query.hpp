// SPDX-License-Identifier: Apache-2.0
// Says which events are meant.
//
//   event("ros2:rcl_publisher_init").with("topic_name", "/ping").where("queue_depth >= 10").in_process("ping")
//
// A query describes itself in failure messages. The functions that add a condition return the query, so that they can
// be chained.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "launch_trace_testing/trace.hpp"

namespace launch_trace_testing {

// An expression of where() is none. what() is "…: TEXT\n" with a line below it that points to the place.
class QueryError : public std::invalid_argument {
 public:
  QueryError(const std::string& what, std::string reason, std::size_t column)
      : std::invalid_argument(what), reason_(std::move(reason)), column_(column) {}
  const std::string& reason() const { return reason_; }  // one line, without the text
  std::size_t column() const { return column_; }         // within the expression, from 0

 private:
  std::string reason_;
  std::size_t column_;
};

class EventQuery {
 public:
  // A name, or a pattern with * and ?. An empty one stands for any event.
  explicit EventQuery(std::string name);

  // The field is equal to the value. A pointer or another number is compared by its value, whatever its sign.
  EventQuery& with(std::string_view field, std::string_view text) &;
  EventQuery& with(std::string_view field, const char* text) & { return with(field, std::string_view(text)); }
  EventQuery& with(std::string_view field, double number) &;
  template <std::integral Integer>
  EventQuery& with(std::string_view field, Integer number) & {
    if constexpr (std::is_signed_v<Integer>) {
      return with(field, Value{std::int64_t{number}});
    } else {
      return with(field, Value{std::uint64_t{number}});
    }
  }
  // The field holds the value of a field of another event.
  EventQuery& with(std::string_view field, const Value& value) &;
  // A condition on fields in the language of `launch trace read --where`: `data > 3 && topic_name =~ "^/p"`. Throws
  // QueryError.
  EventQuery& where(std::string_view expression) &;
  // `process` is the name that the events have as procname (longer ones are cut to 15 characters, as the trace does),
  // a pattern of such names, or the id of the process.
  EventQuery& in_process(std::string_view process) &;
  EventQuery& in_process(std::int64_t vpid) &;
  // Later than this event, in the order of the trace; before it; in its thread.
  EventQuery& after(const Event& event) &;
  EventQuery& before(const Event& event) &;
  EventQuery& in_thread_of(const Event& event) &;
  // At this time or later; before this time. Nanoseconds since the epoch.
  EventQuery& from_time(std::int64_t time_ns) &;
  EventQuery& until_time(std::int64_t time_ns) &;
  // Any other condition. `description` is a clause such as "has an even number" or "whose number is even".
  EventQuery& that(std::string description, std::function<bool(const Event&)> holds,
                   std::vector<std::string> fields = {}) &;

  template <class... Arguments>
  EventQuery with(Arguments&&... arguments) && {
    return std::move(with(std::forward<Arguments>(arguments)...));
  }
  EventQuery where(std::string_view expression) && { return std::move(where(expression)); }
  template <class Process>
  EventQuery in_process(Process process) && {
    return std::move(in_process(process));
  }
  EventQuery after(const Event& event) && { return std::move(after(event)); }
  EventQuery before(const Event& event) && { return std::move(before(event)); }
  EventQuery in_thread_of(const Event& event) && { return std::move(in_thread_of(event)); }
  EventQuery from_time(std::int64_t time_ns) && { return std::move(from_time(time_ns)); }
  EventQuery until_time(std::int64_t time_ns) && { return std::move(until_time(time_ns)); }
  EventQuery that(std::string description, std::function<bool(const Event&)> holds,
                  std::vector<std::string> fields = {}) && {
    return std::move(that(std::move(description), std::move(holds), std::move(fields)));
  }

  bool matches(const Event& event) const;
  bool matches_name(const Event& event) const;
  // In the order of the trace.
  std::vector<const Event*> select(const Trace& trace) const;
  const Event* first(const Trace& trace) const;  // null when there is none

  const std::string& name() const { return name_; }
  // "'ros2:rcl_publisher_init' with topic_name = "/ping", in process 'ping'"
  std::string describe() const;

  // One condition beside the name. `distance` says how far an event is from it: 0 when it holds.
  struct Condition {
    std::string description;
    std::vector<std::string> fields;  // that it looks at
    std::function<double(const Event&)> distance;
  };
  const std::vector<Condition>& conditions() const { return conditions_; }

 private:
  EventQuery& add(std::string description, std::vector<std::string> fields,
                  std::function<double(const Event&)> distance);

  std::string name_;
  std::vector<Condition> conditions_;
};

// The short form.
inline EventQuery event(std::string name) {
  return EventQuery(std::move(name));
}

}  // namespace launch_trace_testing
