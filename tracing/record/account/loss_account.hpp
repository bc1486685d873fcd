// SPDX-License-Identifier: Apache-2.0
// The events that a trace lacks, and the cost of recording it. A session makes this account at its end.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/account/absence.hpp"
#include "tracing/record/account/event_cost.hpp"
#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// What a session had from one process.
struct ProcessAccount {
  std::string name;  // of its program
  std::int64_t pid = 0;
  double seconds = 0;                        // it ran
  double cpu_seconds = 0;                    // processor time of all its threads; 0: unknown, for it was killed
  std::uint64_t events = 0;                  // that it fired and the session recorded or lost, once for each channel
  std::uint64_t callbacks = 0;               // that ended, of its nodes
  std::optional<double> reached_after = {};  // seconds after its begin the first session reached it; nothing: none did
  std::uint64_t missed = 0;                  // events that it fired before
  std::optional<std::uint64_t> lost = {};    // of its events; nothing: unknown
  std::vector<std::string> nodes = {};       // its nodes; looked up when events were lost
  bool counts = true;                        // its events (event_counters.hpp); if not, `events` are those in the trace

  // Estimates, for events that take so many nanoseconds each.
  double tracing_seconds(double ns_per_event) const { return static_cast<double>(events) * ns_per_event / 1e9; }
  double processor_share(double ns_per_event) const;  // of one processor, while it ran
  double own_share(double ns_per_event) const;        // of its own processor time; 0: unknown
  double ns_per_callback(double ns_per_event) const;  // that tracing adds to a callback and what leads to it; 0: none
};

// An unbroken run of losses of one processor. Times are nanoseconds after the trace's first packet began.
struct LossRange {
  std::string cpu;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t events = 0;   // discarded
  std::uint64_t packets = 0;  // overwritten, with an unknown number of events
};

// From begin_ns on the events of a processor were not written. Times count as in LossRange.
struct UnwrittenRange {
  std::string cpu;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;  // when the session was stopped
  std::string channel = {};
  std::optional<std::int64_t> pid = {};  // of the process that owns the buffers, where each process has its own
  bool after_losses = false;             // events were discarded before
  bool in_doubt = false;                 // there may have been no events
};

// What a channel recorded before the first packet that its trace still has.
struct BeforeFirstPacket {
  enum Why {
    kOverwrittenInFiles,  // as asked: the oldest of a limited number of files is overwritten
    kLost,                // in overwrite mode, before they were read
    kRemoved              // the session was cleared, or an archive of it was moved away
  };
  Why why = kLost;
  std::uint64_t packets = 0;
  std::uint64_t discarded_events = 0;        // before the end of the first packet that is left
  std::optional<std::uint64_t> events = {};  // in these packets; nothing: unknown
  bool at_least = false;                     // some processes do not count what they fire

  bool nothing() const { return packets == 0 && discarded_events == 0; }
};

enum class LossSource { kDaemon, kPackets, kTracefs };

// Events of a channel that the tracer could not keep: as the session daemon counts before the session is destroyed, or
// as the packets of the trace tell (packet_losses.hpp).
struct ChannelLoss {
  std::string domain;  // "ust" or "kernel"
  std::string channel;
  std::uint64_t discarded_events = 0;  // event-loss mode: newest events dropped while buffers were full
  std::uint64_t lost_packets = 0;      // overwrite mode: oldest packets overwritten
  LossSource counted_by = LossSource::kPackets;
  std::uint64_t only_daemon_events = 0;   // of discarded_events: those that never got into the count of a packet
  std::uint64_t only_daemon_packets = 0;  // of lost_packets
  BeforeFirstPacket before_first = {};    // not in the two counts

  bool overwrite = false;
  std::uint64_t tracefile_size = 0;  // bytes of a file, of which there are so many; 0: no limit
  std::uint64_t tracefile_count = 0;
  std::uint64_t subbuffer_size = 0;  // bytes
  std::uint64_t subbuffer_count = 0;
  std::uint64_t bytes = 0;             // recorded
  std::vector<LossRange> ranges = {};  // where discarded events and overwritten packets are missing
  std::vector<UnwrittenRange> unwritten = {};
  // Bytes. With so many sub-buffers of this size nothing would have been lost.
  std::uint64_t advised_subbuffer_size = 0;
  std::uint64_t advised_subbuffer_count = 0;
};

// How exactly the lost events are attributed to processes.
enum class LossAttribution {
  kExact,     // the processes lost as much as the channels
  kEstimate,  // they lost more (another session recorded at other times) or less (other programs do not count), or
              // packets are missing, whose events were not counted
  kUnknown
};

// How long a step of the set-up or of the end took, for --timing.
struct SessionStep {
  std::string name;  // "session daemon", "create session", "channel ros2", …
  std::chrono::nanoseconds took;
};

struct LossAccount {
  std::uint64_t discarded_events() const;
  std::uint64_t lost_packets() const;
  // Everything that was recorded is in the trace, nothing was lost, and nobody was absent.
  bool complete() const;
  // Something was lost although the user did not ask to overwrite or remove it.
  bool has_losses() const;

  std::vector<ChannelLoss> channels;
  double seconds = 0;                          // from the first packet to the end of the last; 0: unknown
  std::vector<ProcessAccount> processes = {};  // by the time of their beginning
  LossAttribution attribution = LossAttribution::kUnknown;
  std::uint64_t unattributed = 0;       // lost userspace events of no process in the list
  std::optional<EventCost> cost = {};   // of an event, on this machine
  std::vector<EventCut> cuts = {};      // dropped on purpose: no losses
  bool cut_short = false;               // the wait for the last data was given up
  bool stuck = false;                   // LTTng had data left and wrote nothing any more
  std::vector<std::string> notes = {};  // on the end of the session; nothing that the trace lacks
  std::vector<Absence> absences = {};
  std::vector<std::int64_t> launch_processes = {};  // launch_processes.hpp; empty: of a session without a launch
  std::vector<TracetoolsUse> tracetools = {};       // of processes of another ROS 2
  std::string damage = {};                          // a sentence on data that is missing and was not counted, or ""
  std::string directory = {};           // of the recording or of the snapshots; "" if it is not on this machine
  bool wrote_nothing = false;           // that directory is not there
  bool nothing_to_record = false;       // TraceConfig::nothing_to_record
  bool of_snapshots = false;            // the session kept the newest events only, so its losses mean nothing
  std::string unwritten_verdict = {};   // why verdict.json could not be written
  std::vector<SessionStep> steps = {};  // of the end: "stop", "last data", "destroy", …
};

}  // namespace tracing
