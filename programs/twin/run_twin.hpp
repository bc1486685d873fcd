// SPDX-License-Identifier: Apache-2.0
// Runs a twin that was written, and finds the trace of the run.
#pragma once

#include <filesystem>

namespace twin_program {

// What the launcher and the nodes print to standard output: kShown sends it to standard error. It says where the trace
// is, which is in the way if the trace is to be removed.
enum class RunOutput { kShown, kHidden };

// Starts `launch --isolate FOLDER/twin.xml` and returns the directory of the new trace. `duration_s`: 0 for that of the
// launch file. Throws std::runtime_error if the launch fails or makes no trace.
std::filesystem::path run_twin(const std::filesystem::path& folder, double duration_s,
                               RunOutput output = RunOutput::kShown);

}  // namespace twin_program
