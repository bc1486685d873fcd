// SPDX-License-Identifier: Apache-2.0
// The parts of trace_check.cpp for expectations that need more than a question to the trace. Those that return an
// optional give nullopt if everything is as expected.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launch_trace_testing/trace.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/visit/test_request.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/chains/chain_definition.hpp"

namespace launch {

// How often the callbacks of a node ask for memory.
std::optional<Failure> judge_allocations(const ExpectedAllocations& expected, const tracing::TraceResults& results,
                                         const SourceRange& where);

// How regularly the timers of a node have fired.
std::optional<Failure> judge_timer(const ExpectedTimer& expected, const launch_trace_testing::Trace& trace,
                                   const SourceRange& where);

// The chains that the traces hold, with the names of the definitions, of the events of these processes; nullopt: of
// all. Throws tracing::TraceReadError.
tracing::TraceResults analyse_chains(const std::vector<std::filesystem::path>& directories,
                                     const std::optional<std::set<std::int64_t>>& pids,
                                     const std::vector<tracing::ChainDefinition>& chains);

// The share of the durations that are below; `percentile` is one of those that a summary has.
std::int64_t percentile_of(const tracing::DurationSummary& summary, double percentile);

}  // namespace launch
