// SPDX-License-Identifier: Apache-2.0
// The objects of a timeline.
#pragma once

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

// Fills processes, nodes, topics, endpoints and callbacks. Their indices are the ids of the analysis.
void copy_objects(const TraceAnalysis& analysis, Timeline& timeline);

}  // namespace tracing::timeline
