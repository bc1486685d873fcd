// SPDX-License-Identifier: Apache-2.0
// What is missing of the files of a trace. A stream file that ends at the border of a packet, or is not there, looks
// whole; but LTTng lists the packets of each stream file in a file of `index/`. Private to the reader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tracing {

// A line for each file of the trace that lacks packets of its index, or has more than these. `trace` is a directory
// with metadata that nobody is writing to.
std::vector<std::string> missing_packets(const std::filesystem::path& trace);

// A line for each directory at or below this one that has stream files but no metadata, and that nobody is writing to.
std::vector<std::string> missing_metadata(const std::filesystem::path& directory);

}  // namespace tracing
