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

inline constexpr std::uint64_t kBytesPerLostEvent = 128;  // an event of ros2 with the three contexts has 60 to 110
inline constexpr std::uint64_t kAdvisedSubbuffers = 4;
inline constexpr std::uint64_t kLargestAdvice = std::uint64_t{256} << 20;  // bytes for each processor and channel

// For programs: session, complete, cut_short, discarded_events, lost_packets, channels with their ranges and advice.
std::string verdict_as_json(const LossAccount& account, const std::string& session_name);

// Writes kVerdictFile as a whole; a link at its place is replaced and not followed. Throws TraceError.
void write_verdict(const LossAccount& account, const std::string& session_name, const std::filesystem::path& directory);

// The same for a snapshot: session, reasons, complete, absent, discarded_events, lost_packets, begin_ns and end_ns of
// the trace clock. Complete is a snapshot in which nothing is missing between its first event and its last. Throws
// TraceError.
void write_snapshot_verdict(const std::filesystem::path& directory, const std::string& session_name,
                            const std::vector<std::string>& reasons, const std::vector<Stream>& streams,
                            const std::vector<Absence>& absences);

}  // namespace tracing
