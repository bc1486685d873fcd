// SPDX-License-Identifier: Apache-2.0
// The times of chains of callbacks in the trace of a test.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/chains/chain_definition.hpp"

namespace launch {

// The chains that the trace holds, with the names of the definitions, of the events of these processes. Throws
// tracing::TraceReadError.
tracing::TraceResults analyse_chains(const std::string& directory, const std::set<std::int64_t>& pids,
                                     const std::vector<tracing::ChainDefinition>& chains);

// The share of the durations that are below; `percentile` is one of those that a summary has.
std::int64_t percentile_of(const tracing::DurationSummary& summary, double percentile);

}  // namespace launch
