// SPDX-License-Identifier: Apache-2.0
// Reads a launch file, or another file that errors may point into.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/diagnostics/source.hpp"

namespace launch {

// `included_from` is the place that asks for the file. Throws LaunchError at that place when the file can't be read.
std::shared_ptr<const SourceFile> read_source_file(const std::string& path, SourceRange included_from = {});

// From now on these files have these texts, whatever is on the disk: those of an editor, by absolute path.
void set_unsaved_texts(std::map<std::string, std::string> texts);

}  // namespace launch
