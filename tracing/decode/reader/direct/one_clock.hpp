// SPDX-License-Identifier: Apache-2.0
// The traces of one session on one clock. A session has several traces when each process has buffers of its own, or
// when kernel events are recorded beside. All of them read the same clock of the machine, but LTTng measures its
// distance from the epoch anew for each. So their times differ when the wall clock was set meanwhile, as it is soon
// after a robot has started. Private to the reader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/recording.hpp"

namespace tracing {

struct ClockOfTrace {
  const Recording& recording;
  ctf::TraceClass& declarations;         // whose clock is changed
  std::filesystem::path directory = {};  // of the trace
};

// Gives all traces of a session the largest distance among them, if the distances differ by more than the measurements
// do otherwise: a wall clock is rather put forward than back. Returns a sentence for each such session.
std::vector<std::string> put_on_one_clock(const std::vector<ClockOfTrace>& traces);

}  // namespace tracing
