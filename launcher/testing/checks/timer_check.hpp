// SPDX-License-Identifier: Apache-2.0
// Judges how regularly the timers of a node have fired.
#pragma once

#include <optional>

#include "launch_trace_testing/trace.hpp"
#include "launcher/testing/failure.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

// nullopt: as expected.
std::optional<Failure> judge_timer(const ExpectedTimer& expected, const launch_trace_testing::Trace& trace,
                                   const SourceRange& where);

}  // namespace launch
