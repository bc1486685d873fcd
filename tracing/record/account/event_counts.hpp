// SPDX-License-Identifier: Apache-2.0
// How many events one process has fired, as it says itself.
#pragma once

#include <cstdint>
#include <map>
#include <numeric>
#include <string>

namespace tracing {

struct EventCounts {
  std::int64_t pid = 0;
  std::string process;                          // the name of its program
  std::uint64_t begin = 0;                      // CLOCK_MONOTONIC, ns
  std::uint64_t end = 0;                        // 0: it runs, or was killed
  std::uint64_t cpu = 0;                        // ns of processor time until `end`
  std::uint64_t reached = 0;                    // when the first session reached it, as `begin`; 0: none has
  std::uint64_t missed = 0;                     // events that it fired before, and no state dump has told later
  std::map<std::string, std::uint64_t> events;  // fired while a session recorded them; none that is zero

  std::uint64_t total() const {
    return std::accumulate(events.begin(), events.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& event) { return sum + event.second; });
  }
};

}  // namespace tracing
