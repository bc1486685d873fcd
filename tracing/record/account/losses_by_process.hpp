// SPDX-License-Identifier: Apache-2.0
// Which process lost how much, found out at the end of a session.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/counters/process_ends.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_attribution.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/account/unwritten_data.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// Make one when the session has been stopped and still exists. It fills in the processes of the account, and asks the
// daemon what was recorded if something was lost. Throws nothing: if something cannot be found out, the attribution is
// unknown, and the session ends and its verdict is written all the same.
class LossesByProcess {
 public:
  LossesByProcess(const TraceConfig& config, LossAccount& losses);

  // Processes that did not end properly (unwritten_data.hpp).
  std::vector<std::string> killed() const { return killed_processes(counts_); }

  // Nothing of a session that was paused: LTTng may have ended the streams of its processes before.
  ProcessEnds process_ends() const { return paused_ ? ProcessEnds() : read_process_ends(counters_, counts_); }

  // When the session has gone: which of its rules no program had an event for, by the metadata of the recording.
  void look_for_absent_events(const std::string& recording);

  // When the session has gone, its losses are counted (packet_losses.hpp), and its damage is known. Reads the trace,
  // at some 30 million events a second: when something was lost, or the session records events that no process counts.
  void look_into(const std::string& recording, const std::vector<Stream>& streams);

 private:
  // Some of the recorded events are in no process's counts.
  bool has_uncounted() const;
  void attribute(const RecordedProcesses& recorded, const std::vector<Stream>& streams);
  // Userspace has lost something, and there is time to look.
  bool needed() const;
  // Files of a userspace channel have overwritten packets.
  bool overwrites() const;

  LossAccount& losses_;
  std::string counters_;
  std::vector<EventCounts> counts_;
  RecordedEvents events_;
  bool unknown_ = false;
  bool paused_ = false;
};

}  // namespace tracing
