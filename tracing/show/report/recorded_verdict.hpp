// SPDX-License-Identifier: Apache-2.0
// Reads the verdicts of recordings.
#pragma once

#include <filesystem>
#include <vector>

#include "tracing/model/timeline/recorded_verdict.hpp"

namespace tracing {

// What all files verdict.json in the directories and below them say, each once. A file that cannot be read says
// nothing.
RecordedVerdict read_verdicts(const std::vector<std::filesystem::path>& directories);

}  // namespace tracing
