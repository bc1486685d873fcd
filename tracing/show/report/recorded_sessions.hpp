// SPDX-License-Identifier: Apache-2.0
// The sessions whose traces a report reads as one.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "tracing/decode/reader/event.hpp"

namespace tracing {

// The names of the sessions of a machine, if there are several of one machine; both halves of a dual session are one.
// A name stands twice when two sessions have it.
std::vector<std::string> several_sessions(const std::deque<TraceDescription>& traces);

}  // namespace tracing
