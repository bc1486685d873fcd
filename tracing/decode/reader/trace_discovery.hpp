// SPDX-License-Identifier: Apache-2.0
// Finds the CTF traces below a directory. Private to the reader.
#pragma once

#include <filesystem>
#include <vector>

namespace tracing {

// Directories to be read as one trace: the chunks of a rotated session have the same identity and continue each other.
using TraceDirectories = std::vector<std::filesystem::path>;

// The directories with metadata at or below `directory`, sorted. Throws TraceReadError when there is none.
std::vector<std::filesystem::path> find_traces(const std::filesystem::path& directory);

// One entry per trace, in the order of their paths.
std::vector<TraceDirectories> group_by_identity(const std::vector<std::filesystem::path>& directories);

}  // namespace tracing
