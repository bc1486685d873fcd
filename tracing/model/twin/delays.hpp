// SPDX-License-Identifier: Apache-2.0
// How long it takes until a message or a timer that is due gets its callback, apart from what waits for the executor:
// that is for the simulation to find.
#pragma once

#include <vector>

#include "tracing/model/twin/description/distribution.hpp"
#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/executors.hpp"
#include "tracing/model/twin/recording.hpp"
#include "tracing/model/twin/run_times.hpp"

namespace tracing::twin {

struct WayTimes {
  // From the publication, or the time when a timer is due, to the begin of the callback, if thread and group had
  // nothing else to do.
  Distribution delays;
  Distribution near_delays;  // of messages of the same process, if others come, too
  Distribution gaps;         // from the end of the callback before to the begin, if it was due by then
  Distribution ways;         // from the publication, or the time when a timer is due, to the begin, of all
};

// By callback of the timeline.
std::vector<WayTimes> way_times(const Recording& recording, const FoundExecutors& executors, const RunTimes& runs);

// Sets the delays of services and of the callbacks of clients. `client_of`: the client of the system, by that of the
// recording, or kNone.
void set_call_delays(const Recording& recording, const std::vector<Index>& client_of, System& system);

}  // namespace tracing::twin
