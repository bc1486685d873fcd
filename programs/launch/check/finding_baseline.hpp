// SPDX-License-Identifier: Apache-2.0
// The findings that were there before: a file of them, so that `launch check --baseline` tells only of new ones.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

// JSON: version and findings, each with id, file, message and count. Files are relative to the folder of the baseline.
// Lines are not kept, as they move with every change.
void write_baseline(const std::string& path, const std::vector<Diagnostic>& found);  // throws LaunchError

struct ComparedWithBaseline {
  std::size_t known = 0;  // findings that were left out
  std::size_t gone = 0;   // findings of the baseline that were not found
};

// Leaves out the findings of the baseline. Throws LaunchError when the file can't be read.
ComparedWithBaseline leave_out_known(const std::string& path, std::vector<Diagnostic>& found);

}  // namespace launch
