// SPDX-License-Identifier: Apache-2.0
// Data that LTTng's consumer could not write: on a full file system or beyond a disk quota it gives up the stream of a
// processor for good, without an error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// Adds to each userspace channel of `account` the times from which on its streams were not written any more. A session
// that is stopped writes a last packet of every stream. A stream is therefore incomplete if its last packet ends before
// `stopped` (CLOCK_MONOTONIC, ns; 0: unknown, nothing is added). Buffers that were full at the stop get no last packet
// either: where events were lost after the last packets, streams count only when there is `no_room`. A process that has
// buffers of its own ends its streams when it ends; such streams are left out. So are the
// streams of a session that was rotated: without events after the rotation they get no last packet.
void find_unwritten(LossAccount& account, const std::vector<Stream>& streams, std::uint64_t stopped, bool no_room);

// Why a file in `directory` can't grow, as a sentence: "the file system of DIRECTORY is full". "" when it can.
std::string why_no_room(const std::filesystem::path& directory);

// A sentence that tells which events are missing without a count, and the remedy. "" if nothing is missing. `no_room`
// is the result of why_no_room().
std::string describe_damage(const LossAccount& account, const std::string& no_room,
                            const std::filesystem::path& directory);

}  // namespace tracing
