// SPDX-License-Identifier: Apache-2.0
// Whether events can be recorded with the context fields that are asked for. LTTng records none at all, and says
// nothing, when a thread's performance counter can't be opened.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

// Tries it: a session of its own records one event of the program `probe` (launch-trace-probe) with these fields of
// userspace. Takes some tenths of a second. Needs a session daemon. Throws TraceError.
bool records_an_event(const std::vector<std::string>& context_fields, const std::filesystem::path& probe);

// One warning for each performance counter that keeps userspace events from being recorded. Without counters nothing is
// tried.
std::vector<std::string> context_warnings(const std::vector<ChannelPlan>& channels);

}  // namespace tracing
