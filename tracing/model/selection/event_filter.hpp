// SPDX-License-Identifier: Apache-2.0
// Chooses the events of a trace that the user wants.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tracing/decode/reader/event_pattern.hpp"
#include "tracing/model/selection/event_condition.hpp"
#include "tracing/model/selection/node_filter.hpp"

namespace tracing {

// A bound of a range of time. It counts from the epoch, or from the first event of the trace.
struct TimeBound {
  std::int64_t ns = 0;
  bool since_first = false;

  // Reads "1767225600.5" (seconds since the epoch), "2026-01-01T12:00:00.5" (UTC) or "+1.5" (seconds after the first
  // event). Returns nothing for other text.
  static std::optional<TimeBound> parse(std::string_view text);

  // No time is at `begin` or later, and before `end`. False if only a trace can tell, because one of them counts from
  // its first event and the other does not.
  static bool leave_nothing(const std::optional<TimeBound>& begin, const std::optional<TimeBound>& end) {
    return begin && end && begin->since_first == end->since_first && begin->ns >= end->ns;
  }
};

class EventFilter {
 public:
  // One entry of each list must match; an empty list accepts all events.
  std::vector<std::string> events;         // patterns of names
  std::vector<std::string> processes;      // process ids, or patterns of names as `procname` has them
  std::vector<std::string> nodes;          // patterns of names, as NodeFilter has them
  std::vector<EventCondition> conditions;  // all must hold
  std::optional<TimeBound> begin;          // included
  std::optional<TimeBound> end;            // not included

  // Must be called for each event of the trace, in order.
  bool accepts(const Event& event);
  // Whether its name alone decides about an event. Then accepts_name() tells the same as accepts().
  bool is_of_names() const { return processes.empty() && nodes.empty() && conditions.empty() && !begin && !end; }
  bool accepts_name(const EventClass& event_class);
  // The event is at `end` or later. As all later events are, too, the reading may end here.
  bool is_behind(const Event& event);
  // What no event has fitted so far, wherever in time: of `events`, and of `processes`; and what there was instead:
  // names of events, and "name [id]" of processes, sorted. Processes are noted if some are wanted.
  std::vector<std::string> missing_events() const;
  std::vector<std::string> missing_processes() const;
  std::vector<std::string> event_names() const { return {event_names_.begin(), event_names_.end()}; }
  std::vector<std::string> process_names() const;

  // To be called before the events of another reading.
  void restart() {
    names_.clear();
    event_names_.clear();
    seen_processes_.clear();
    first_ns_.reset();
    node_filter_.reset();
  }
  // Null if all events of any node are wanted, or no event has come yet.
  const NodeFilter* node_filter() const { return node_filter_.get(); }

 private:
  void note_first(const Event& event) {
    if (!first_ns_) {
      first_ns_ = event.timestamp_ns;
    }
  }
  std::int64_t absolute(const TimeBound& bound) const;
  bool accepts_process(const Event& event);

  std::vector<std::int8_t> names_;  // by EventClass::id: 1 accepted, 0 not, -1 not known yet
  std::set<std::string> event_names_;
  std::map<std::string, std::set<std::optional<std::int64_t>>, std::less<>> seen_processes_;  // ids by name
  std::optional<std::int64_t> first_ns_;
  std::unique_ptr<NodeFilter> node_filter_;
};

}  // namespace tracing
