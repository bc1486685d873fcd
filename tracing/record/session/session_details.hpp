// SPDX-License-Identifier: Apache-2.0
// A session that exists, as `launch trace list` and `status` show it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"

namespace tracing {

// One of the sessions that exist.
struct SessionSummary {
  std::string name;
  std::string path;  // of the trace; empty for a snapshot session
  bool active = false;
  bool snapshot = false;
  std::int64_t created = 0;  // seconds since the epoch
};

struct ChannelDetails {
  std::string domain;  // "ust" or "kernel"
  std::string name;
  std::uint64_t subbuffer_size = 0;   // bytes
  std::uint64_t subbuffer_count = 0;  // for each processor
  bool overwrite = false;
  std::vector<std::string> events;  // rules, sorted
};

struct SessionDetails {
  SessionSummary summary;
  std::vector<ChannelDetails> channels;
  LossAccount losses;
  // Seconds since which the events of a processor are lost because a process died within an event, by processor.
  std::map<std::uint32_t, double> held_up = {};
};

}  // namespace tracing
