// SPDX-License-Identifier: Apache-2.0
// Makes the buffers of a trace small enough for the shared memory that there is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {

// Makes the userspace sub-buffers of `plans` smaller, with a warning, until the buffers of one user fit into `free`
// bytes of shared memory. Throws TraceError if even the smallest sub-buffers do not fit.
void fit_into_shared_memory(std::vector<ChannelPlan>& plans, std::uint64_t free, std::uint64_t processors,
                            std::vector<std::string>& warnings);

}  // namespace tracing
