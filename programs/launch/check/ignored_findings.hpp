// SPDX-License-Identifier: Apache-2.0
// Comments in launch files that leave findings out: <!-- launch: ignore LF0501: read by the deployment -->.
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace launch {

// Removes the findings that a comment of their file ignores: those on the line of the comment, and on the first line
// after it when the comment has its line for itself. Adds findings for comments of `file` that are wrong: an id that
// there is not, no reason, nothing to ignore. `file` is the launch file that is checked, null when it can't be read.
void leave_out_ignored(const std::shared_ptr<const SourceFile>& file, std::vector<Diagnostic>& found);

}  // namespace launch
