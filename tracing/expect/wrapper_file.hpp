// SPDX-License-Identifier: Apache-2.0
// The launch file of a run: a session, around the launch file and the programs of the test.
#pragma once

#include <filesystem>
#include <string>

#include "launch_trace_testing/launch_run.hpp"

namespace launch_trace_testing {

// XML. The session writes to `trace_directory`/`session`.
std::string wrapper_file(const RunOptions& options, const std::string& session,
                         const std::filesystem::path& trace_directory);

}  // namespace launch_trace_testing
