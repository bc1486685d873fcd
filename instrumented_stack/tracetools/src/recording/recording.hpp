// SPDX-License-Identifier: Apache-2.0
#pragma once

// Records events of plain fields (record_functions.hpp) as LTTng's generated probes do, with one function for all
// events. LTTng's macros generate a probe for each event, and a function that calls it. At the rate of messages the
// code of each has to come from memory again, and that takes longer than to run it.

#include <lttng/ust-events.h>

#include <cstddef>

#include "counters/event_counters.hpp"
#include "probes/probes.hpp"

namespace tracetools {

// Calls a probe with the values of a payload.
using ProbeCall = void (*)(const Probe& probe, const void* payload);

// Counts the event, and records it into each session and channel that wants it. `call` is used for probes that must be
// called: those that filter, those of triggers, and those that are not LTTng's.
void record(const Tracepoint& tracepoint, CountedEvent event, const void* payload, std::size_t size, ProbeCall call);

// Null if the probe does something else than to record into a channel.
const lttng_ust_event_recorder* recorder_of(const Probe& probe) noexcept;

// Tells which functions are LTTng's probes of a provider. Call it when the provider has been loaded. Until then all
// probes are called.
void add_generated_probes(const lttng_ust_probe_desc& provider) noexcept;

}  // namespace tracetools
