// SPDX-License-Identifier: Apache-2.0
// Streams that end before their recording does. LTTng hands over a packet when all events in it are complete, and the
// packets of a stream in their order. A process that dies within an event therefore ends the stream of its processor
// for good, as does a packet that LTTng's consumer cannot write because the file system is full; neither is reported.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/counters/process_ends.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// The streams that lack their end, each with the time from which on it is missing. `stopped` is when the session was
// asked to stop, or the snapshot was asked for (CLOCK_MONOTONIC, ns). At this moment LTTng ends a packet of every
// stream, also of idle ones. A stream is therefore unfinished if its last packet ends before. If the moment is not
// known (0), as of a session that was paused before, the streams are compared with one another. The streams of a
// process that has buffers of its own end when it ends (process_ends.hpp). The streams of the kernel are left out.
std::vector<UnwrittenRange> unfinished_streams(const std::vector<Stream>& streams, std::uint64_t stopped,
                                               const ProcessEnds& lived_until = {});

// Adds the unfinished streams to the channels of `account`, unless the wait for their data was given up.
void find_unwritten(LossAccount& account, const std::vector<Stream>& streams, std::uint64_t stopped,
                    const ProcessEnds& lived_until = {});

// Processes of `counts` that are gone and did not end properly: "planner [4711]".
std::vector<std::string> killed_processes(const std::vector<EventCounts>& counts);

// Whether every shared stream of the recording in `directory` has a packet that ends after `stopped`, as LTTng's index
// files tell. True if that cannot be known.
bool streams_end_after(const std::filesystem::path& directory, const std::set<std::string>& channels_in_files,
                       std::uint64_t stopped);

// Returns when every shared stream of the recording in `directory` has a packet that ends after `stopped`, as
// LTTng's index files tell. A thread that was interrupted within an event at the stop completes its packet when it runs
// again. False after kLongestCommit, or when give_up says so.
bool wait_for_last_packets(const std::filesystem::path& directory, const std::set<std::string>& channels_in_files,
                           std::uint64_t stopped, const std::function<bool()>& give_up);

// Why a file in `directory` can't grow, as a sentence: "the file system of DIRECTORY is full". "" when it can.
std::string why_no_room(const std::filesystem::path& directory);

// What is known about the reason for missing ends.
struct EndOfStreams {
  std::string no_room = {};              // the result of why_no_room()
  std::vector<std::string> killed = {};  // the result of killed_processes()
};

// Sentences that tell which events are missing without a count, and the remedy. "" if nothing is missing.
std::string describe_damage(const LossAccount& account, const EndOfStreams& known);

// The same for the streams of a snapshot.
std::string describe_unfinished(const std::vector<UnwrittenRange>& unfinished, const std::vector<std::string>& killed);

}  // namespace tracing
