// SPDX-License-Identifier: Apache-2.0
// What stand-ins need beside their work: the way from the executor to the work, and sending that takes longer than it
// did.
#pragma once

#include "tracing/model/twin/figures.hpp"

namespace tracing::twin {

// Sets Callback::overhead_ns by what was recorded of a run of the twin, which has the overheads of before.
void add_overheads(const Figures& recorded, const Figures& run, System& system);

}  // namespace tracing::twin
