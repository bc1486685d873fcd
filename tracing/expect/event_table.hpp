// SPDX-License-Identifier: Apache-2.0
// Events as a table in failure messages, and the choice of those that are worth showing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "launch_trace_testing/event_query.hpp"

namespace launch_trace_testing {

inline constexpr std::size_t kMostRows = 6;
inline constexpr std::size_t kTableWidth = 120;  // columns

struct TableRow {
  const Event* event = nullptr;
  std::string note = {};  // stands in front of the fields
};

// A line for each event: seconds since the first event of the trace, process, name, fields. The fields named in `first`
// come first; what does not fit is left out. Above `kMostRows` the rows in the middle are left out. Lines begin with a
// newline and two blanks. Empty without rows.
std::string event_table(const Trace& trace, const std::vector<TableRow>& rows,
                        const std::vector<std::string>& first = {});

// The events that come nearest to what the query says, in the order of the trace: of its name, with the fewest and
// smallest differences. A note says which conditions do not hold.
std::vector<TableRow> nearest_events(const Trace& trace, const EventQuery& query);

// What there is instead: the table of the nearest events under a headline, or the names that are like it.
std::string nearest_text(const Trace& trace, const EventQuery& query);

// The names of all fields that the query looks at.
std::vector<std::string> fields_of(const EventQuery& query);

// "+0.012345678"
std::string relative_time(const Trace& trace, std::int64_t time_ns);
// "12.345 ms"
std::string duration_text(std::int64_t ns);
// "1 event", "2 events", "0 processes"
std::string counted(std::size_t count, const std::string& noun);

}  // namespace launch_trace_testing
