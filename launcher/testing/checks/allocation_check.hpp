// SPDX-License-Identifier: Apache-2.0
// <allocations node="…" state="…" max="…"/>
#pragma once

#include <optional>

#include "launcher/testing/failure.hpp"
#include "launcher/visit/trace_expectation.hpp"
#include "tracing/model/analysis/results.hpp"

namespace launch {

std::optional<Failure> judge_allocations(const ExpectedAllocations& expected, const tracing::TraceResults& results,
                                         const SourceRange& where);

}  // namespace launch
