// SPDX-License-Identifier: Apache-2.0
// Which launch arguments the text of a file reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

// Whether the file may read the argument: it has $(var NAME), or reads a name that is computed, or it is a Python
// launch file that has the name as a text.
bool may_read(const SourceFile& file, std::string_view name);

// Whether the launcher itself reads the configuration.
bool is_own_configuration(std::string_view name);
// Those configurations.
std::vector<std::string> own_configurations();

}  // namespace launch
