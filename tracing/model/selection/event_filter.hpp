// SPDX-License-Identifier: Apache-2.0
// Chooses the events of a trace that the user wants.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
  // To be called before the events of another reading.
  void restart() {
    names_.clear();
    first_ns_.reset();
    node_filter_.reset();
  }
  // Null if all events of any node are wanted, or no event has come yet.
  const NodeFilter* node_filter() const { return node_filter_.get(); }

 private:
  std::int64_t absolute(const TimeBound& bound, const Event& event);
  bool accepts_process(const Event& event) const;

  std::vector<std::int8_t> names_;  // by EventClass::id: 1 accepted, 0 not, -1 not known yet
  std::optional<std::int64_t> first_ns_;
  std::unique_ptr<NodeFilter> node_filter_;
};

}  // namespace tracing
