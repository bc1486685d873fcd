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

// Until when a process lived at least, by its number: CLOCK_MONOTONIC, ns.
using ProcessEnds = std::map<std::int64_t, std::uint64_t>;

// Notes in the directory of the counters that the launch has seen the end of a process at `time`. Does nothing for "".
void note_process_end(const std::string& counters, pid_t pid, std::uint64_t time);

// As they were noted, and as the processes of `counts` say themselves.
ProcessEnds read_process_ends(const std::string& counters, const std::vector<EventCounts>& counts);

// The streams of one process with buffers of its own. When it has ended, LTTng's consumer ends all of them within some
// microseconds, and each gets a last packet, also if no event is in it. A stream whose last event is incomplete gets
// none: it ends with a packet that was full, or that the switch timer ended. That timer, too, ends the packets of all
// streams within some microseconds.
class EndOfProcess {
 public:
  // `lived_until`: 0 if it is not known.
  EndOfProcess(const std::vector<const Stream*>& streams, std::uint64_t lived_until);

  // The time at which the stream has to end, or later.
  std::uint64_t expected_end(const Stream& stream) const;

 private:
  std::uint64_t end_ = 0;  // of all its streams
  std::uint64_t least_ = 0;
  std::vector<std::pair<const Stream*, std::uint64_t>> earlier_;  // the ends of packets that others followed
};

}  // namespace tracing
