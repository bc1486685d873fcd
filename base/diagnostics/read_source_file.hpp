// SPDX-License-Identifier: Apache-2.0
// Reads a launch file, or another file that errors may point into.
#pragma once

#include <memory>
#include <string>

#include "base/diagnostics/source.hpp"

namespace launch {

// `included_from` is the place that asks for the file. Throws LaunchError at that place when the file can't be read.
std::shared_ptr<const SourceFile> read_source_file(const std::string& path, SourceRange included_from = {});

}  // namespace launch
