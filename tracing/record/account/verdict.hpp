// SPDX-License-Identifier: Apache-2.0
// Whether a trace is complete. If it is not: what is missing, and which buffers would have been large enough.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// The verdict stands in this file of the recording's directory.
inline constexpr const char* kVerdictFile = "verdict.json";

// Adds to each channel of `account` where its events were lost and, if some were, the buffers that would have held
// them, from the streams of its recording. count_in_packets() comes before.
//
// The rule: while events are lost, the buffers of a processor are full. They lacked room for the longest unbroken run
// of losses, at kBytesPerLostEvent for each event. The advice is twice the sum of the present size and this room, in
// kAdvisedSubbuffers sub-buffers of a power of two. Beyond kLargestAdvice there is no advice, because buffers can't
// help against such an overload. A channel in files of a limited size gets more sub-buffers, but not larger ones.
void explain_losses(LossAccount& account, const std::vector<Stream>& streams);

inline constexpr std::uint64_t kBytesPerLostEvent = 128;  // an event of ros2 with the three contexts has 45 on average
inline constexpr std::uint64_t kAdvisedSubbuffers = 4;
inline constexpr std::uint64_t kLargestAdvice = std::uint64_t{256} << 20;  // bytes for each processor and channel

// For programs: session, complete, cut_short, discarded_events, lost_packets, channels with their ranges and advice.
std::string verdict_as_json(const LossAccount& account, const std::string& session_name);

// Writes kVerdictFile as a whole; a link at its place is replaced and not followed. Throws TraceError.
void write_verdict(const LossAccount& account, const std::string& session_name, const std::filesystem::path& directory);

// Tells in the verdict of a trace's first recording that another one was appended, and whether it is complete: the
// field `appended`, and `complete` of all of them. Throws TraceError.
void note_appended(const std::filesystem::path& appended, bool complete);

// The same for a snapshot: session, reasons, complete, damage, absent, discarded_events, lost_packets, unwritten,
// begin_ns and end_ns of the trace clock. Complete is a snapshot in which nothing is missing between its first event
// and the moment at which it was asked for. Throws TraceError.
struct SnapshotAccount {
  std::vector<std::string> reasons = {};
  std::vector<Absence> absences = {};
  std::vector<UnwrittenRange> unwritten = {};       // streams that end before that moment
  std::string damage = {};                          // a sentence on them
  std::vector<std::int64_t> launch_processes = {};  // as of LossAccount
};
void write_snapshot_verdict(const std::filesystem::path& directory, const std::string& session_name,
                            const SnapshotAccount& account, const std::vector<Stream>& streams);

}  // namespace tracing
