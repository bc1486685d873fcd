// SPDX-License-Identifier: Apache-2.0
// A trace session around a run: it starts before the first process and is finished after the last process has gone.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "launcher/visit/run_scope.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/record/account/counter_directory.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/overhead_guard.hpp"
#include "tracing/record/plan/plan_channels.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/event_watch.hpp"
#include "tracing/record/session/flight_recorder.hpp"
#include "tracing/record/session/run_watch.hpp"
#include "tracing/record/session/tracer.hpp"

namespace launch {

// The attributes of <trace> that concern the launcher rather than the tracer.
struct TraceChoices {
  // Patterns of the nodes and processes to record; all are recorded when this is not given.
  std::optional<std::vector<std::string>> nodes = {};
  bool auto_buffers = false;  // userspace buffers sized from the number of processes and processors
  // Reasons for a snapshot: a process dies unasked, the launcher gets this signal (0: none), an event matches.
  bool snapshot_on_crash = false;
  int snapshot_on_signal = 0;
  std::vector<std::string> snapshot_on_events = {};
  // Further reasons: a callback takes longer, or a message is older, than so many milliseconds; 0: no such reason.
  double callback_deadline = 0;
  double message_deadline = 0;
  bool report = false;                                // a page is made of the trace at its end
  std::vector<tracing::ChainDefinition> chains = {};  // for the report
  std::vector<NamedNode> chain_nodes = {};            // those that the chains pass

  bool flight_recorder() const { return snapshot_on_crash || snapshot_on_signal != 0 || !watched_events().empty(); }
  // The events that cause a snapshot.
  std::vector<std::string> watched_events() const;
};

class TraceScope : public RunScope {
 public:
  // `prefix` is the folder of bin/launch, which ends the session of a killed launcher, and lib/launch/launch-report,
  // which describes a finished trace in one line and as a page.
  TraceScope(tracing::TraceConfig config, std::unique_ptr<tracing::Tracer> tracer, std::string prefix,
             SourceRange origin, TraceChoices choices = {});
  ~TraceScope() override;

  void expect(const std::vector<ProcessSpec>& processes) override;
  void begin(EventLoop& loop, Tell tell, Completion done) override;
  void end(EventLoop& loop, Tell tell, Completion done) override;
  void hurry() override { hurry_ = true; }
  std::vector<std::string> clean_up_command() override;
  void prepare(ProcessSpec& spec) const override;
  bool wants_records() const override { return tracing::records_launch_events(config_); }
  void record(const LaunchRecord& record) override;
  void observe_snapshots(SnapshotObserver observer) override { snapshot_observer_ = std::move(observer); }
  std::string kind() const override { return "trace"; }
  std::vector<ScopeSetting> describe() const override;
  std::vector<TimedStep> timing() const override;
  const SourceRange& origin() const override { return origin_; }
  std::vector<NamedNode> named_nodes() const override { return choices_.chain_nodes; }

 private:
  // Runs `work` on a thread of its own, because the tracer's calls block, then `finished` on the loop's thread.
  void in_background(EventLoop& loop, std::function<void()> work, std::function<void(std::exception_ptr)> finished);
  void tell_result(const Tell& tell) const;
  bool traces(const ProcessSpec& spec) const;
  void look_around_later(EventLoop& loop, const Tell& tell);
  void summarize();
  void make_report();
  void guard_overhead(EventLoop& loop, const Tell& tell);
  // Ends a session that has begun although its setup failed.
  void end_failed_session();
  // Returns a sentence if it fails.
  std::string write_chains() const;
  void start_flight_recorder(EventLoop& loop, const Tell& tell);

  tracing::TraceConfig config_;
  std::unique_ptr<tracing::Tracer> tracer_;
  std::string prefix_;
  SourceRange origin_;
  TraceChoices choices_;
  std::int64_t created_;  // when this scope was made, in seconds since the epoch
  std::vector<std::string> preload_;
  std::shared_ptr<tracing::CounterDirectory> counters_;
  tracing::SetupReport setup_;
  tracing::LossAccount losses_;
  std::string summary_;
  std::string report_;  // path of the page; empty: none could be made
  std::atomic<bool> hurry_ = false;
  SnapshotObserver snapshot_observer_;
  EventLoop::SourcePtr signals_;
  EventLoop::SourcePtr look_around_;
  std::unique_ptr<tracing::FlightRecorder> flight_recorder_;
  std::unique_ptr<tracing::EventWatch> event_watch_;
  std::unique_ptr<tracing::OverheadGuard> overhead_guard_;
  std::unique_ptr<tracing::RunWatch> run_watch_;
  std::thread worker_;
};

}  // namespace launch
