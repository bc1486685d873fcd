// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "probes/probes.hpp"

namespace tracetools {

struct StackTracepoint {
  const char* group;  // as tracetools/event_table.h describes it: "init"
  Tracepoint* tracepoint;
};

// The tracepoints of `ros2` and `ros2_ext`.
std::span<const StackTracepoint> stack_tracepoints();

// Enables all of them that have no probe, or disables them again. Call it for the latter on the thread that LTTng
// calls for a state dump, because LTTng attaches no probe meanwhile.
void enable_without_probes(bool enabled);

}  // namespace tracetools
