// SPDX-License-Identifier: Apache-2.0
// What would go wrong only when a node reads its parameter file, as remarks of a visit that explores.
#pragma once

#include <string>

#include "launcher/visit/launch_context.hpp"

namespace launch {

// A node ends when its parameter file is no YAML, or when a value stands outside of ros__parameters. The places are in
// the file, which is read once for each visit.
void find_faults_of_parameter_file(const std::string& path, const SourceRange& where, LaunchContext& context);

}  // namespace launch
