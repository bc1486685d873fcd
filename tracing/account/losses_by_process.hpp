// SPDX-License-Identifier: Apache-2.0
// Which process lost how much, found out at the end of a session.
#pragma once

#include <string>
#include <vector>

#include "tracing/account/event_counters.hpp"
#include "tracing/account/loss_account.hpp"
#include "tracing/account/recorded_events.hpp"
#include "tracing/plan/trace_config.hpp"

namespace tracing {

// Make one when the session has been stopped and still exists: it fills in the account's processes, and asks the daemon
// what was recorded where something was lost. What cannot be found out leaves the attribution unknown: the session ends
// and its verdict is written all the same. Throws nothing.
class LossesByProcess {
 public:
  LossesByProcess(const TraceConfig& config, LossAccount& losses);

  // When the session has gone. Reads the trace, which takes a second for a million events; only when something was
  // lost.
  void look_into(const std::string& recording);

 private:
  // Userspace has lost something, and there is time to look.
  bool needed() const;

  LossAccount& losses_;
  std::vector<EventCounts> counts_;
  RecordedEvents events_;
  bool unknown_ = false;
};

}  // namespace tracing
