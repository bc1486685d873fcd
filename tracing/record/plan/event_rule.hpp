// SPDX-License-Identifier: Apache-2.0
// What an entry of events-ust or events-kernel asks for:
//
//   PATTERN [except PATTERN[,PATTERN]…] [level [=]LEVEL] [if FILTER]
//
// PATTERN is an event's name, in which * matches any text. `except` takes events out again. `level WARNING` takes
// events that are at least as severe as WARNING, `level =WARNING` events of exactly this severity. FILTER is LTTng's
// filter expression and goes up to the end: the event is recorded where it is true (lttng-enable-event(1)).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tracing {

struct EventRule {
  std::string pattern;
  std::vector<std::string> exclusions;
  std::optional<int> log_level;     // enum lttng_loglevel
  bool exactly_that_level = false;  // else: or more severe
  std::string filter;

  bool plain() const { return exclusions.empty() && !log_level && filter.empty(); }
};

// Throws TraceError if the text is no rule.
EventRule parse_event_rule(const std::string& text);

// The rule with its exclusions applied: one rule for each event of provider ros2 that is left. Throws TraceError for
// exclusions from other providers, because their events are not known before a program with them runs. LTTng itself
// could exclude them, but the session daemon of LTTng 2.13 crashes, and all sessions with it, as soon as somebody lists
// a session with exclusions.
std::vector<EventRule> expand_exclusions(const EventRule& rule);

// The pattern alone, also of a text that is no rule.
std::string event_pattern(std::string_view text);
std::vector<std::string> event_patterns(const std::vector<std::string>& texts);

}  // namespace tracing
