// SPDX-License-Identifier: Apache-2.0
// The counts of processes that have ended, in one file beside the counter files of those that run.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tracing/record/account/event_counts.hpp"

namespace tracing {

// By the name of the counter file that the process had. Empty if there is no such file.
std::map<std::string, EventCounts> read_ended_processes(const std::filesystem::path& directory);

// Replaces the file as a whole. False if it cannot be written.
bool write_ended_processes(const std::filesystem::path& directory, const std::map<std::string, EventCounts>& ended);

}  // namespace tracing
