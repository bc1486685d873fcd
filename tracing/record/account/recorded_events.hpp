// SPDX-License-Identifier: Apache-2.0
// Which events a session records, as the session daemon knows it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tracing {

// What the userspace channels of a session record.
struct RecordedEvents {
  struct Rule {
    std::string channel;
    std::string pattern;
    std::vector<std::string> exclusions = {};
    bool conditional = false;  // a filter or a log level decides

    bool takes(const std::string& event) const;
  };
  std::vector<Rule> rules;
  bool python = false;  // also what Python programs log

  // In how many channels the event is recorded, each time that it is fired.
  std::size_t times(const std::string& event) const;
  // False for an event with a condition: a process counts the event whether a filter takes it or not, so that nothing
  // is known of its losses.
  bool countable(const std::string& event) const;
};

// Whether the launcher or `launch trace` adds rules of this provider by itself.
bool is_our_own(const std::string& event);

// Whether processes of the stack count the events of this name or pattern (event_counters.hpp).
bool is_counted(const std::string& event);

// What the userspace channels of the session record. Throws TraceError.
RecordedEvents read_recorded_events(const std::string& lttng_session_name);

}  // namespace tracing
