// SPDX-License-Identifier: Apache-2.0
// A channel of a trace: how large its buffers are and what is recorded into it.
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
  bool overwrite = false;            // keep the newest events rather than the oldest: what a snapshot needs
  std::uint64_t tracefile_size = 0;  // bytes
  std::uint64_t tracefile_count = 0;
};

}  // namespace tracing
