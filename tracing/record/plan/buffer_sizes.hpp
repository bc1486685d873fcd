// SPDX-License-Identifier: Apache-2.0
// How large the buffers of a trace are: large enough for its events, estimated before the launch from the number of
// nodes, each as busy as a busy node, and small enough for the shared memory that there is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// What a busy node fires: 200 messages a second that are received, handled and answered, ten events each.
inline constexpr std::uint64_t kEventsPerNode = 2000;  // per second
inline constexpr std::uint64_t kBytesPerEvent = 100;   // with the three context fields
// How much longer than its read timer the consumer may be kept from reading, on a busy machine.
inline constexpr double kConsumerDelay = 0.15;  // seconds

// Bytes of a userspace sub-buffer, a power of two, so that `config.ust.subbuffer_count` of them for each of
// `processors` hold the events of `nodes`. Never less than the default.
std::uint64_t sufficient_subbuffer_size(const TraceConfig& config, std::size_t nodes, std::size_t processors);

// A sentence when the userspace buffers of `config` don't hold the events of `nodes` by this estimate, else "".
std::string buffer_warning(const TraceConfig& config, std::size_t nodes, std::size_t processors);

// Makes the userspace sub-buffers of `plans` smaller, with a warning, until the buffers of one user fit into `free`
// bytes of shared memory. Throws TraceError if even the smallest sub-buffers do not fit.
void fit_into_shared_memory(std::vector<ChannelPlan>& plans, std::uint64_t free, std::uint64_t processors,
                            std::vector<std::string>& warnings);

}  // namespace tracing
