// SPDX-License-Identifier: Apache-2.0
// Runs a twin that was written, and finds the trace of the run.
#pragma once

#include <filesystem>

namespace twin_program {

// Starts `launch --isolate FOLDER/twin.xml`, whose output goes to standard error, and returns the directory of the new
// trace. `duration_s`: 0 for that of the launch file. Throws std::runtime_error if the launch fails or makes no trace.
std::filesystem::path run_twin(const std::filesystem::path& folder, double duration_s);

}  // namespace twin_program
