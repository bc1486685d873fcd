// SPDX-License-Identifier: Apache-2.0
// What would go wrong only when a process starts, as remarks of a visit that explores.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

void find_missing_directory(const std::string& directory, const SourceRange& where, LaunchContext& context);
void find_missing_cpus(const std::vector<int>& cpus, const SourceRange& where, LaunchContext& context);
// A node ends when it can't read one of its remaps.
void find_invalid_remap(const std::string& from, const SourceRange& from_where, const std::string& to,
                        const SourceRange& to_where, LaunchContext& context);

}  // namespace launch
