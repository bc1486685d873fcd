// SPDX-License-Identifier: Apache-2.0
// How long the way of a message takes, apart from what waits for executors and processors: that is for the simulation
// to find.
#pragma once

#include <vector>

#include "tracing/model/twin/description/distribution.hpp"
#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/executors.hpp"
#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

struct WayTimes {
  Distribution delays;  // from the publication to the begin of the callback, if thread and group had nothing else to do
  Distribution gaps;    // from the end of the callback before to the begin, if the message was there by then
};

// By callback of the timeline. `cpus`: of the machine. A delay is taken from messages beside which the callbacks left a
// processor free, if there are enough of them.
std::vector<WayTimes> way_times(const Recording& recording, const FoundExecutors& executors, std::size_t cpus);

// Sets the delays of services and of the callbacks of clients. `client_of`: the client of the system, by that of the
// recording, or kNone.
void set_call_delays(const Recording& recording, const std::vector<Index>& client_of, System& system);

}  // namespace tracing::twin
