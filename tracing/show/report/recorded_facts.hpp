// SPDX-License-Identifier: Apache-2.0
// What recordings say of themselves beside their events: their sessions and their verdicts.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/timeline/recorded_verdict.hpp"

namespace tracing {

// The names of the sessions of a machine, if there are several of one machine; both halves of a dual session are one.
// A name stands twice when two sessions have it.
std::vector<std::string> several_sessions(const std::deque<TraceDescription>& traces);

// What all files verdict.json in the directories and below them say, each once. A file that cannot be read says
// nothing.
RecordedVerdict read_verdicts(const std::vector<std::filesystem::path>& directories);

}  // namespace tracing
