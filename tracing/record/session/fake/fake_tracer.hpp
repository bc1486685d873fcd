// SPDX-License-Identifier: Apache-2.0
// A Tracer without LTTng, for tests: records its calls, and fails or blocks where it is told to.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/traceable_events.hpp"
#include "tracing/record/session/tracer.hpp"

namespace tracing {

// Set it up before it is called. Everything else may be called from any thread.
class FakeTracer : public Tracer {
 public:
  // What the calls give back or throw.
  SetupReport setup_report;  // its trace directory is filled in by start()
  LossAccount losses;
  std::optional<LossAccount> losses_in_pause;
  std::string snapshot_directory;
  std::vector<SessionSummary> session_list;
  TraceableEvents events;
  std::optional<TraceError> start_error;
  std::optional<TraceError> finish_error;
  std::optional<TraceError> verb_error;  // of pause, resume, record_snapshot and status

  // From now on finish() does not return before release() is called or its give_up says true.
  void block_finish();
  void release();
  // Returns once a blocked finish() is waiting.
  void wait_until_finishing();

  // "start NAME", "finish NAME", "give up NAME", "pause NAME", … with the LTTng session's name, in the order of calls.
  std::vector<std::string> calls() const;
  // The sessions started and not finished.
  std::vector<std::string> open_sessions() const;
  // What start() was given last.
  std::optional<TraceConfig> last_config() const;

  SetupReport start(const TraceConfig& config) override;
  std::unique_ptr<RunWatch> watch(const TraceConfig&, std::function<void(const std::string&)>) override {
    return nullptr;
  }
  LossAccount finish(const TraceConfig& config, const std::function<bool()>& give_up) override;
  std::optional<LossAccount> pause(const std::string& lttng_session_name) override;
  void resume(const std::string& lttng_session_name) override;
  std::string record_snapshot(const std::string& lttng_session_name) override;
  std::vector<SessionSummary> sessions() override;
  SessionDetails status(const std::string& lttng_session_name) override;
  TraceableEvents traceable_events() override;
  std::vector<std::string> unreachable_processes() override { return {}; }
  void save(const std::string& lttng_session_name, const std::string& directory) override;
  void load(const std::string& lttng_session_name, const std::string& directory) override;

 private:
  void record(const std::string& call);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> calls_;
  std::vector<std::string> open_sessions_;
  std::optional<TraceConfig> last_config_;
  bool finish_blocked_ = false;
  bool finishing_ = false;
};

}  // namespace tracing
