// SPDX-License-Identifier: Apache-2.0
// The buffers that traced processes fill and LTTng's consumer empties, looked at from outside. What stands in them now
// decides about events that no file has yet. LTTng describes the place of each field at the beginning of a buffer, for
// its tool lttng-crash.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace tracing {

// A packet with an event that a thread has begun and not completed. Its stream goes on when that has happened.
struct OpenPacket {
  std::uint64_t buffer = 0;     // a name of the stream while the consumer runs
  std::uint64_t position = 0;   // of the packet in its stream, bytes
  std::string trace;            // the UUID in the metadata of its trace: 00112233-4455-…
  std::uint32_t processor = 0;  // of the stream
  std::uint64_t begin = 0;      // of the packet, trace clock

  bool operator==(const OpenPacket&) const = default;
  bool operator<(const OpenPacket& other) const {
    return std::tie(buffer, position, trace, processor, begin) <
           std::tie(other.buffer, other.position, other.trace, other.processor, other.begin);
  }
};

// The open packets of all sessions of these consumers. A busy thread leaves its event within a microsecond, so a packet
// is left out that is seen once without an open event. None of a consumer whose files this user may not see. Costs some
// ten microseconds for each stream.
std::vector<OpenPacket> open_packets(const std::vector<pid_t>& consumers);

}  // namespace tracing
