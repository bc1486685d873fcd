// SPDX-License-Identifier: Apache-2.0
// What is missing of the files of a trace. A stream file that ends at the border of a packet, or is not there, looks
// whole; but LTTng lists the packets of each stream file in a file of `index/`, and the verdict of a recording has the
// size of all of them. Private to the reader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tracing {

// A line for each file of the trace that lacks packets of its index. `trace` is a directory with metadata that nobody
// is writing to.
std::vector<std::string> missing_packets(const std::filesystem::path& trace);

// A line for each directory at or below this one that has stream files but no metadata, and that nobody is writing to.
std::vector<std::string> missing_metadata(const std::filesystem::path& directory);

// How many bytes the packets of each domain ("ust", "kernel") had together when it was recorded, by its verdict.json.
// A domain is not there when the verdict does not know all of its packets.
std::map<std::string, std::uint64_t> recorded_bytes(const std::filesystem::path& trace);

// A line if there is a verdict.json that can't be read; else empty.
std::string broken_verdict(const std::filesystem::path& trace);

}  // namespace tracing
