// SPDX-License-Identifier: Apache-2.0
// The channels of a trace: which there are, how large their buffers are and what is recorded into each.
#pragma once

#include <lttng/domain.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// "ust" or "kernel".
std::string domain_name(lttng_domain_type domain);

// One channel of a session and everything that is recorded into it.
struct ChannelPlan : ChannelBuffers {
  lttng_domain_type domain = LTTNG_DOMAIN_UST;
  BufferOwner buffers = BufferOwner::kUser;  // of userspace
  std::string channel;
  std::vector<EventRule> events;
  std::vector<std::string> syscalls;
  std::vector<std::string> context_fields;
  std::uint32_t switch_timer = 0;    // µs
  bool python = false;               // the events are loggers of Python programs
  bool overwrite = false;            // keep the newest events rather than the oldest: what a snapshot needs
  std::uint64_t tracefile_size = 0;  // bytes
  std::uint64_t tracefile_count = 0;
};

// What Python programs log is recorded into a channel that LTTng calls so.
inline constexpr const char* kPythonChannel = "lttng_python_channel";

// The channels into which `config` records something: `ros2`, kPythonChannel and `kchan`, with `init_channel` also
// `ros2_init`, and the channels of `config.channels`. A name that occurs twice is recorded once. A default event that
// one of `config.channels` records is recorded in that channel only. Warnings (a sub-buffer size that had to be rounded
// up) are appended. Throws TraceError for a context field or an event rule that does not exist, and for attributes that
// exclude each other.
std::vector<ChannelPlan> plan_channels(const TraceConfig& config, std::vector<std::string>& warnings);

// Whether a channel records the launcher's own events: `launch_events`, beside events of programs.
bool records_launch_events(const TraceConfig& config);

}  // namespace tracing
