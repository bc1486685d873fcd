// SPDX-License-Identifier: Apache-2.0
// Text between the elements of an XML launch file, which has no effect.
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

// A warning for each text. The file must have been loaded; one that is no XML has none.
std::vector<Diagnostic> find_stray_text(const std::shared_ptr<const SourceFile>& file);

}  // namespace launch
