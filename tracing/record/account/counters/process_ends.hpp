// SPDX-License-Identifier: Apache-2.0
// When processes have ended, and where the streams of those have to end that have buffers of their own.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// CLOCK_MONOTONIC, ns; 0: not known.
struct ProcessEnd {
  std::uint64_t lived_until = 0;        // at least
  std::uint64_t may_have_lived_to = 0;  // not longer
  bool operator==(const ProcessEnd&) const = default;
};
using ProcessEnds = std::map<std::int64_t, ProcessEnd>;  // by process

// Notes in the directory of the counters that the launch has seen the end of a process at `time`. Does nothing for "".
// `died`: not with exit code 0.
void note_process_end(const std::string& counters, pid_t pid, std::uint64_t time, bool died);

// As they were noted, and as the processes of `counts` say themselves.
ProcessEnds read_process_ends(const std::string& counters, const std::vector<EventCounts>& counts);

// The streams of one process with buffers of its own. When it has ended, LTTng's consumer ends all of them within some
// microseconds, and each gets a last packet, also if no event is in it. A stream whose last event is incomplete gets
// none: it ends with a packet that was full, or that the switch timer ended. That timer, too, ends the packets of all
// streams within some microseconds.
class EndOfProcess {
 public:
  EndOfProcess(const std::vector<const Stream*>& streams, const ProcessEnd& end);

  // The time at which the stream has to end, or later.
  std::uint64_t expected_end(const Stream& stream) const;
  // Until when the stream may lack events although it has ended then: its last packet may be one that the timer ended
  // just before the process died. 0: it lacks none.
  std::uint64_t doubtful_until(const Stream& stream) const;

 private:
  std::uint64_t end_ = 0;  // of all its streams
  std::uint64_t least_ = 0;
  std::uint64_t doubtful_until_ = 0;
  std::vector<std::pair<const Stream*, std::uint64_t>> earlier_;  // the ends of packets that others followed
};

}  // namespace tracing
