// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "probes/probes.hpp"

namespace tracetools {

// Makes a thread of lttng-ust call `dump` whenever a session asks this process for its state: when the session starts
// or resumes, or when a user runs `lttng regenerate statedump`. Call it once, before liblttng-ust.so is loaded. False
// if this lttng-ust cannot do it.
//
// While `dump` runs, the tracer's control of this process waits. `dump` may record events. `lives` is true
// when LTTng asks for the session itself: LTTng does not free it meanwhile. One that was put off, see below, may be
// freed.
bool on_state_dump(void (*dump)(Session* session, bool lives));

// Until this is called, sessions that ask are put off; it calls `dump` for them. Call it when LTTng knows the events
// of the provider, if there may be objects by then: a session that starts while lttng-ust is loaded asks before that,
// and would get nothing.
void begin_state_dumps();

// Calls `dump` for the sessions that record events of this process now. A program that was linked with lttng-ust loads
// it before this library, and then sessions have asked before on_state_dump(). Call it when the provider is loaded.
void dump_to_sessions_before();

}  // namespace tracetools
