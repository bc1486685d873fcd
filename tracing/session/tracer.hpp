// SPDX-License-Identifier: Apache-2.0
// Controls trace sessions. The seam between the product and LTTng.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tracing/session/event_cost.hpp"
#include "tracing/session/trace_config.hpp"

namespace tracing {

// A trace could not be set up, or control over it was lost. what() is one line; remedy() says what to do, may be empty.
class TraceError : public std::runtime_error {
 public:
  explicit TraceError(const std::string& what, std::string remedy = {})
      : std::runtime_error(what), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

// How long a step of the set-up or of the end took, for --timing.
struct SessionStep {
  std::string name;  // "session daemon", "create session", "channel ros2", …
  std::chrono::nanoseconds took;
};

// An unbroken run of losses of one processor. Times are nanoseconds after the trace's first packet began.
struct LossRange {
  std::string cpu;
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t events = 0;
};

// What a processor recorded from then on could not be written. Times as of a LossRange.
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
  std::uint64_t advised_subbuffer_size =
      0;  // with kAdvisedSubbuffers (verdict.hpp) of them nothing would have been lost
};

// What a session had from one process that counts its events (event_counters.hpp).
struct ProcessAccount {
  std::string name;  // of its program
  std::int64_t pid = 0;
  double seconds = 0;                      // it ran
  double cpu_seconds = 0;                  // processor time of all its threads; 0: unknown, for it was killed
  std::uint64_t events = 0;                // of it that the session recorded or lost, one for each channel
  std::uint64_t callbacks = 0;             // of its nodes that ended
  std::optional<std::uint64_t> lost = {};  // of its events; nothing: unknown
  std::vector<std::string> nodes = {};     // its nodes; looked up when events were lost

  // Estimates, for events that take so many nanoseconds each.
  double tracing_seconds(double ns_per_event) const { return static_cast<double>(events) * ns_per_event / 1e9; }
  double processor_share(double ns_per_event) const;  // of one processor, while it ran
  double own_share(double ns_per_event) const;        // of its own processor time; 0: unknown
  double ns_per_callback(double ns_per_event) const;  // that a callback, with what leads to it, takes longer; 0: none
};

// How far it is known which process the lost events are of.
enum class LossAttribution {
  kExact,     // the processes' sum is what the daemon counts; what it counts more is of programs that don't count
  kEstimate,  // the sum is more: another session recorded at other times
  kUnknown
};

// A class of events (event_classes.hpp) that was dropped because recording cost too much.
struct EventCut {
  std::string event_class = {};
  std::vector<std::string> events = {};
  std::int64_t time = 0;   // CLOCK_MONOTONIC, ns
  std::uint64_t rate = 0;  // events a second of all processes before it
  double share = 0;        // of a processor that they cost, estimated
};

struct LossAccount {
  std::uint64_t discarded_events() const;
  std::uint64_t lost_packets() const;
  bool complete() const { return discarded_events() == 0 && lost_packets() == 0 && !cut_short && damage.empty(); }

  std::vector<ChannelLoss> channels;
  std::vector<ProcessAccount> processes = {};  // by the time of their beginning
  LossAttribution attribution = LossAttribution::kUnknown;
  std::uint64_t unattributed = 0;       // lost userspace events that are of none of them
  std::optional<EventCost> cost = {};   // of an event, on this machine
  std::vector<EventCut> cuts = {};      // dropped on purpose: no losses
  bool cut_short = false;               // the wait for the last data was given up
  std::string damage = {};              // what keeps the trace from being complete and nobody has counted, a sentence
  std::string unwritten_verdict = {};   // why verdict.json could not be written
  std::vector<SessionStep> steps = {};  // of the end: "stop", "last data", "destroy", …
};

struct SetupReport {
  std::string trace_directory;  // or the address of the relay daemon
  bool started_daemon = false;
  std::vector<SessionStep> steps;
  std::vector<std::string> warnings;
  std::string notes = {};  // nothing that is wrong with the session
};

// One of the sessions that exist.
struct SessionSummary {
  std::string name;
  std::string path;  // of the trace; empty for a snapshot session
  bool active = false;
  bool snapshot = false;
  std::int64_t created = 0;  // seconds since the epoch
};

struct ChannelDetails {
  std::string domain;  // "ust" or "kernel"
  std::string name;
  std::uint64_t subbuffer_size = 0;   // bytes
  std::uint64_t subbuffer_count = 0;  // for each processor
  bool overwrite = false;
  std::vector<std::string> events;  // rules, sorted
};

struct SessionDetails {
  SessionSummary summary;
  std::vector<ChannelDetails> channels;
  LossAccount losses;
};

struct TraceableEvent {
  std::string name;
  std::vector<std::string> processes;  // "NAME PID" of those that can fire it
};

// What can be recorded now. Userspace events are known of running programs only.
struct TraceableEvents {
  bool started_daemon = false;
  std::vector<TraceableEvent> userspace;
  std::vector<std::string> kernel;
  std::size_t syscalls = 0;
  std::string why_no_kernel;  // empty when kernel events can be recorded
  std::string kernel_remedy;
  std::vector<std::string> context_fields_ust;
  std::vector<std::string> context_fields_kernel;
};

// All calls block, some for hundreds of milliseconds: call them from a thread of your own, one at a time.
class Tracer {
 public:
  virtual ~Tracer() = default;

  // Checks, creates, configures and starts the session. Throws TraceError with nothing left behind.
  virtual SetupReport start(const TraceConfig& config) = 0;

  // Stops recording, waits until the consumer has written everything, reads the losses, destroys the session.
  // `give_up` is asked from time to time while waiting; when it says true, the session is destroyed at once, with what
  // is written by then. Leaves the verdict in the recording's directory (verdict.hpp), but for snapshot sessions, which
  // lose all but the newest events by design. Throws TraceError when the session can't be reached any more.
  virtual LossAccount finish(const TraceConfig& config, const std::function<bool()>& give_up) = 0;

  // The verbs of `launch trace`. Each throws TraceError and leaves the session as it is on error.
  virtual void pause(const std::string& lttng_session_name) = 0;
  virtual void resume(const std::string& lttng_session_name) = 0;
  virtual void record_snapshot(const std::string& lttng_session_name) = 0;
  virtual std::vector<SessionSummary> sessions() = 0;
  virtual SessionDetails status(const std::string& lttng_session_name) = 0;
  virtual TraceableEvents traceable_events() = 0;
  // Warnings of running programs that no session can record (unreachable_processes.hpp).
  virtual std::vector<std::string> unreachable_processes() = 0;
  // Writes the session's configuration, not what it recorded, as SESSION.lttng into the directory; and creates the
  // session again from there, recording if it was. An empty directory is LTTng's own for the user.
  virtual void save(const std::string& lttng_session_name, const std::string& directory) = 0;
  virtual void load(const std::string& lttng_session_name, const std::string& directory) = 0;
};

// The real one, on liblttng-ctl.
std::unique_ptr<Tracer> make_lttng_tracer();

}  // namespace tracing
