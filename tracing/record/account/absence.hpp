// SPDX-License-Identifier: Apache-2.0
// What a recording lacks because a process, or the events that it was made for, were not there.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

struct Absence {
  std::string text;      // a sentence
  bool is_loss = false;  // events were fired and are missing

  bool operator==(const Absence&) const = default;
};

// Processes that no session has reached, or only after they had fired events.
std::vector<Absence> absent_processes(const std::vector<EventCounts>& counts);

// Processes that have events, but no buffers in the snapshot with these streams. Where each process has buffers of its
// own, LTTng throws them away when the process ends.
std::vector<Absence> absent_from_snapshot(const std::vector<EventCounts>& counts, const std::vector<Stream>& streams);

// The names of the userspace events that programs of the recording have, fired or not: the events in its metadata. A
// program that registers with the session daemon declares all its events that the session's rules take. Nothing if some
// metadata cannot be read.
std::optional<std::set<std::string>> declared_events(const std::filesystem::path& recording);

// Rules of the session that no program had an event for, if their events are none of ROS 2's; programs of older
// versions lack some of these. One sentence if nothing at all could be recorded. The rules that the launcher adds by
// itself do not count there, but its own events must not be missing. `nothing_to_record`: that nothing was recorded is
// right.
std::vector<Absence> absent_events(const RecordedEvents& events, const std::set<std::string>& declared,
                                   bool nothing_to_record = false);

}  // namespace tracing
