// SPDX-License-Identifier: Apache-2.0
// Finds the events that several sessions have recorded, so that each counts once.
//
// A tracepoint hands its event to one session after another. So the copies are neighbours among the events of their
// thread.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

class RepeatedEvents {
 public:
  // Whether it is a copy of the event of its thread before. `session`: a number for the session that has recorded it.
  bool is_copy(const Event& event, std::uint32_t process, std::uint32_t session) {
    const std::uint64_t bit = std::uint64_t{1} << session % 64;
    Last& last = last_[{process, event.vtid.value_or(0)}];
    if (last.name == event.name() && (last.sessions & bit) == 0) {
      last.sessions |= bit;
      return true;
    }
    last = {event.name(), bit};
    return false;
  }

 private:
  struct Last {
    std::string_view name;  // lives as long as the reader
    std::uint64_t sessions = 0;
  };
  std::map<std::pair<std::uint32_t, std::int64_t>, Last> last_;  // by process and thread
};

}  // namespace tracing
