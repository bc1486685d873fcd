// SPDX-License-Identifier: Apache-2.0
// Which channels a trace has, how large their buffers are, and what is recorded into each.
#pragma once

#include <lttng/domain.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/session/event_rule.hpp"
#include "tracing/session/trace_config.hpp"

namespace tracing {

// "ust" or "kernel".
std::string domain_name(lttng_domain_type domain);

// One channel of a session and everything that is recorded into it.
struct ChannelPlan {
  lttng_domain_type domain = LTTNG_DOMAIN_UST;
  BufferOwner buffers = BufferOwner::kUser;  // of userspace
  std::string channel;
  std::vector<EventRule> events;
  std::vector<std::string> syscalls;
  std::vector<std::string> context_fields;
  std::uint64_t subbuffer_size = 0;   // bytes
  std::uint64_t subbuffer_count = 0;  // for each processor
  std::uint32_t read_timer = 0;       // µs
  std::uint32_t switch_timer = 0;     // µs
  bool overwrite = false;             // keep the newest events rather than the oldest: what a snapshot needs
  std::int64_t blocking_timeout = 0;  // µs; -1: for ever
  std::uint64_t tracefile_size = 0;   // bytes
  std::uint64_t tracefile_count = 0;
};

// The channels into which `config` records something: `ros2` and `kchan`, with `init_channel` also `ros2_init`, and
// those of `config.channels`. What occurs twice is taken once, and a default event that a channel of `config.channels`
// takes is taken there only. Warnings (a sub-buffer size that had to be rounded up) are appended. Throws TraceError for
// what can't be had: a context field, an event rule, or attributes that exclude each other.
std::vector<ChannelPlan> plan_channels(const TraceConfig& config, std::vector<std::string>& warnings);

// Makes the userspace sub-buffers of `plans` smaller, with a warning, until those of one user fit into `free` bytes of
// shared memory. Throws TraceError when the smallest don't.
void fit_into_shared_memory(std::vector<ChannelPlan>& plans, std::uint64_t free, std::uint64_t processors,
                            std::vector<std::string>& warnings);

}  // namespace tracing
