// SPDX-License-Identifier: Apache-2.0
// Whether events can be recorded with the context fields that are asked for. LTTng records none at all, and says
// nothing, when a thread's performance counter can't be opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/context_fields.hpp"

namespace tracing {

// Why this process cannot count it (no such hardware counter, no permission), or "" when it can.
std::string why_not_countable(const PerfCounter& counter);

// One for each thread counter that cannot be counted here: LTTng would record no event at all then, without an error.
std::vector<std::string> perf_warnings(const std::vector<std::string>& context_fields_ust);

// Tries it: a session of its own records one event of the program `probe` (launch-trace-probe) with these fields of
// userspace. Takes some tenths of a second. Needs a session daemon. Throws TraceError.
bool records_an_event(const std::vector<std::string>& context_fields, const std::filesystem::path& probe);

// One warning for each performance counter that keeps userspace events from being recorded. Without counters nothing is
// tried.
std::vector<std::string> context_warnings(const std::vector<ChannelPlan>& channels);

}  // namespace tracing
