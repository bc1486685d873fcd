// SPDX-License-Identifier: Apache-2.0
// The events of two processes that exchange one message each way, as an instrumented stack records them.
//
// `ping` (71) has a 500 ms timer that publishes /ping, and a subscription to /pong. `pong` (72) answers /ping from
// within its callback. Names of rcl handles are in upper case, those of rmw handles in lower case.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing::testing {

struct SequenceEvent {
  std::int64_t time_ns;
  Thread thread;
  ros2::AnyEvent event;
};

inline constexpr Thread kPing{71, 71, "ping"};
inline constexpr Thread kPong{72, 72, "pong"};

// 2026-01-01 00:00:00 UTC
inline constexpr std::int64_t kPingPongBegin = 1'767'225'600'000'000'000;

std::vector<SequenceEvent> ping_pong_sequence();

}  // namespace tracing::testing
