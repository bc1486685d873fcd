// SPDX-License-Identifier: Apache-2.0
// Controls trace sessions. The seam between the product and LTTng.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/run_watch.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/traceable_events.hpp"

namespace tracing {

struct SetupReport {
  std::string trace_directory;  // or the address of the relay daemon
  bool started_daemon = false;
  std::vector<SessionStep> steps;
  std::vector<std::string> warnings;
  std::string notes = {};  // nothing that is wrong with the session
};

// All calls block, some for hundreds of milliseconds: call them from a thread of your own, one at a time. Other
// threads may use LTTng's library meanwhile (lttng_ctl.hpp).
class Tracer {
 public:
  virtual ~Tracer() = default;

  // Checks, creates, configures and starts the session. Throws TraceError with nothing left behind.
  virtual SetupReport start(const TraceConfig& config) = 0;

  // Watches what the session depends on from now on (run_watch.hpp). Null if nothing does.
  virtual std::unique_ptr<RunWatch> watch(const TraceConfig& config, std::function<void(const std::string&)> told) = 0;

  // Stops recording, waits until the consumer has written everything, reads the losses, destroys the session.
  // `give_up` is asked from time to time while waiting; when it says true, the session is destroyed at once, with what
  // is written by then. Leaves the verdict in the recording's directory (verdict.hpp), but for snapshot sessions, which
  // lose all but the newest events by design. Throws TraceError when the session can't be reached any more.
  virtual LossAccount finish(const TraceConfig& config, const std::function<bool()>& give_up) = 0;

  // The verbs of `launch trace`. Each throws TraceError and leaves the session as it is on error.
  // pause() gives the account of what is recorded so far, as finish() does; nothing for a session whose trace is not on
  // this machine, for one of snapshots, and for one that was paused already.
  virtual std::optional<LossAccount> pause(const std::string& lttng_session_name) = 0;
  virtual void resume(const std::string& lttng_session_name) = 0;
  // Gives the directory of the snapshot, with its verdict in it; "" if a relay daemon got it.
  virtual std::string record_snapshot(const std::string& lttng_session_name) = 0;
  virtual std::vector<SessionSummary> sessions() = 0;
  virtual SessionDetails status(const std::string& lttng_session_name) = 0;
  virtual TraceableEvents traceable_events() = 0;
  // Warnings of running programs that no session can record (unreachable_processes.hpp).
  virtual std::vector<std::string> unreachable_processes() = 0;
  // save() writes the configuration of the session as SESSION.lttng into the directory, without its events. load()
  // creates the session again from there, and records if the saved session was recording. An empty directory stands for
  // LTTng's directory of the user.
  virtual void save(const std::string& lttng_session_name, const std::string& directory) = 0;
  virtual void load(const std::string& lttng_session_name, const std::string& directory) = 0;
};

// The real one, on liblttng-ctl.
std::unique_ptr<Tracer> make_lttng_tracer();

}  // namespace tracing
