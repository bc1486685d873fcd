// SPDX-License-Identifier: Apache-2.0
// A trace session around a launch: it starts before the first process and is finished after the last process has gone.
// What the session does is tracing::TracedRun; here are its thread, its signal and the processes that it records.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "actions/trace/trace_settings.hpp"
#include "launcher/traced/traced_processes.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/session/traced_run.hpp"

namespace launch {

// The end of a process as the reason for a snapshot. `code`: its exit code, -N for signal N.
std::string end_as_reason(const std::string& process, std::int32_t code);

// Must be called before anything starts a thread: in one that does not block the signal, it would end the launcher.
void block_snapshot_signal(const TraceChoices& choices);

class TraceScope : public RunScope {
 public:
  // The evaluated settings. They may be changed before begin().
  tracing::TraceConfig& config() { return run_.config(); }

  // `prefix`: see tracing::TracedRun.
  TraceScope(TraceRequest request, std::unique_ptr<tracing::Tracer> tracer, std::string prefix, SourceRange origin);
  ~TraceScope() override;

  void expect(const std::vector<ProcessSpec>& processes) override { processes_.expect(processes, true); }
  // The same, of a launch that has other processes on other machines.
  void expect_some(const std::vector<ProcessSpec>& processes) { processes_.expect(processes, false); }
  // As tracing::TracedRun::leave_snapshots_to(). Ends of processes are no reasons then.
  void leave_snapshots_to(tracing::TracedRun::SnapshotWish wish) {
    leaves_snapshots_ = true;
    run_.leave_snapshots_to(std::move(wish));
  }
  // Takes one, between begin() and end(). `done` is called in the loop, once.
  void take_part_of_snapshot(EventLoop& loop, tracing::SnapshotOrder order,
                             std::function<void(const tracing::TakenSnapshot&)> done);
  void begin(EventLoop& loop, Tell tell, Completion done) override;
  void end(EventLoop& loop, Tell tell, Completion done) override;
  void hurry() override { run_.hurry(); }
  std::vector<std::string> clean_up_command() override { return run_.clean_up_command(); }
  void prepare(ProcessSpec& spec) const override;
  bool wants_records() const override { return tracing::records_launch_events(run_.config()); }
  void record(const LaunchRecord& record) override;
  void observe_snapshots(SnapshotObserver observer) override { snapshot_observer_ = std::move(observer); }
  std::string kind() const override { return "trace"; }
  std::vector<ShownSetting> describe() const override {
    return shown_settings(trace_settings(), TraceRequest{run_.config(), choices_});
  }
  std::vector<TimedStep> timing() const override;
  const SourceRange& origin() const override { return origin_; }
  std::vector<NamedNode> named_nodes() const override { return choices_.chain_nodes; }

 private:
  // Runs `work` on a thread of its own, because the calls of the session block, then `finished` on the loop's thread.
  // An error of the session becomes one at the place of the <trace>, behind `context`.
  void in_background(EventLoop& loop, std::string context, std::function<void()> work, Completion finished);
  SourceRange origin_;
  TraceChoices choices_;
  tracing::TracedRun run_;
  mutable TracedProcesses processes_;  // changes with each process that is prepared
  Tell tell_;                          // empty until the session begins
  SnapshotObserver snapshot_observer_;
  EventLoop::SourcePtr signals_;
  EventLoop::SourcePtr look_around_;
  bool leaves_snapshots_ = false;
  std::thread worker_;
  std::thread snapshot_worker_;
};

}  // namespace launch
