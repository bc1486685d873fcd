// SPDX-License-Identifier: Apache-2.0
// Decides which channels a trace has, how large their buffers are, and what is recorded into each.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// The channels into which `config` records something: `ros2` and `kchan`, with `init_channel` also `ros2_init`, and the
// channels of `config.channels`. A name that occurs twice is recorded once. A default event that one of
// `config.channels` records is recorded in that channel only. Warnings (a sub-buffer size that had to be rounded up)
// are appended. Throws TraceError for a context field or an event rule that does not exist, and for attributes that
// exclude each other.
std::vector<ChannelPlan> plan_channels(const TraceConfig& config, std::vector<std::string>& warnings);

// Whether a channel records the launcher's own events: `launch_events`, beside events of programs.
bool records_launch_events(const TraceConfig& config);

}  // namespace tracing
