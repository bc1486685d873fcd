// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a session records of state dumps.

#include <cstdint>

#include "probes/probes.hpp"

namespace tracetools {

// The tracepoint of an init event that the session records. Null if it records none.
const Tracepoint* recorded_init_tracepoint(const ProbesInUse& probes, const Session* session);

// The session has a rule for `ros2_session:no_state_dump`. A rule for all events does not count, which also takes
// `ros2_session:any`.
bool wants_no_dump(const ProbesInUse& probes, const Session* session);

// Records ros2_ext:state_dump_begin or state_dump_end into the session alone.
void record_dump_begin(const ProbesInUse& probes, const Session* session, std::uint64_t events);
void record_dump_end(const ProbesInUse& probes, const Session* session, std::uint64_t events);

}  // namespace tracetools
