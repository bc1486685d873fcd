// SPDX-License-Identifier: Apache-2.0
// What a trace lacks, and what recording it has cost: the account that the end of a session gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/account/event_cost.hpp"
#include "tracing/account/event_cuts.hpp"
#include "tracing/account/process_account.hpp"
#include "tracing/account/session_step.hpp"

namespace tracing {

// An unbroken run of losses of one processor. Times are nanoseconds after the trace's first packet began.
struct LossRange {
  std::string cpu;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t events = 0;
};

// From begin_ns on the events of a processor could not be written. Times count as in LossRange.
struct UnwrittenRange {
  std::string cpu;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;  // when the session was stopped
};

// Events of a channel that the tracer could not keep, as its counters say just before the session is destroyed.
struct ChannelLoss {
  std::string domain;  // "ust" or "kernel"
  std::string channel;
  std::uint64_t discarded_events = 0;  // event-loss mode: newest events dropped while buffers were full
  std::uint64_t lost_packets = 0;      // overwrite mode: oldest packets overwritten

  std::uint64_t subbuffer_size = 0;  // bytes
  std::uint64_t subbuffer_count = 0;
  std::uint64_t bytes = 0;             // recorded
  std::vector<LossRange> ranges = {};  // where the discarded events are missing
  std::vector<UnwrittenRange> unwritten = {};
  // Bytes. With kAdvisedSubbuffers (verdict.hpp) of this size nothing would have been lost.
  std::uint64_t advised_subbuffer_size = 0;
};

// How far it is known which process the lost events are of.
enum class LossAttribution {
  kExact,     // the processes lost no more than the daemon counts; other programs, which do not count, lost the rest
  kEstimate,  // the processes lost more than the daemon counts: another session recorded at other times
  kUnknown
};

struct LossAccount {
  std::uint64_t discarded_events() const;
  std::uint64_t lost_packets() const;
  bool complete() const { return discarded_events() == 0 && lost_packets() == 0 && !cut_short && damage.empty(); }

  std::vector<ChannelLoss> channels;
  std::vector<ProcessAccount> processes = {};  // by the time of their beginning
  LossAttribution attribution = LossAttribution::kUnknown;
  std::uint64_t unattributed = 0;       // lost userspace events of no process in the list
  std::optional<EventCost> cost = {};   // of an event, on this machine
  std::vector<EventCut> cuts = {};      // dropped on purpose: no losses
  bool cut_short = false;               // the wait for the last data was given up
  std::string damage = {};              // a sentence on data that is missing and was not counted, or ""
  std::string unwritten_verdict = {};   // why verdict.json could not be written
  std::vector<SessionStep> steps = {};  // of the end: "stop", "last data", "destroy", …
};

}  // namespace tracing
