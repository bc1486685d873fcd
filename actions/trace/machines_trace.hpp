// SPDX-License-Identifier: Apache-2.0
// A trace of all machines of a launch, or of one other machine: a session on each, begun before any process starts on
// any. Their recordings come into one directory, with a folder for each machine and one verdict. A launch on this
// machine alone has a TraceScope, as if this were not there.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "actions/trace/snapshot_rounds.hpp"
#include "actions/trace/trace_scope.hpp"
#include "actions/trace/trace_settings.hpp"
#include "launcher/traced/machine_recorder.hpp"
#include "launcher/visit/machines.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/account/machines_verdict.hpp"

namespace launch {

// A sentence if the clock of a machine is so far ahead that it spoils what snapshot-on-late-message goes by; "" if not.
std::string warning_of_clock(const std::string& machine, std::int64_t ahead_ns, double message_deadline_ms);

class MachinesTrace : public RunScope {
 public:
  struct Settings {
    std::optional<std::string> only;  // the one machine to record; else all
    bool collects = true;             // recordings of other machines are fetched at the end
    std::string prefix;               // of this installation
  };

  // `here` is null if this machine is not recorded; its request is the same. `recorders` may be null, if nothing will
  // run; else it must outlive the scope.
  MachinesTrace(TraceRequest request, std::unique_ptr<TraceScope> here, MachineRecorders* recorders, Settings settings,
                SourceRange origin);
  ~MachinesTrace() override;

  void expect(const std::vector<ProcessSpec>& processes) override;
  void begin(EventLoop& loop, Tell tell, Completion done) override;
  void end(EventLoop& loop, Tell tell, Completion done) override;
  void hurry() override;
  std::vector<std::string> clean_up_command() override;
  void prepare(ProcessSpec& spec) const override;
  bool wants_records() const override { return here_ && here_->wants_records(); }
  void record(const LaunchRecord& record) override;
  void observe_snapshots(SnapshotObserver observer) override;
  std::string kind() const override { return "trace"; }
  std::vector<ShownSetting> describe() const override { return shown_settings(trace_settings(), request_); }
  std::vector<TimedStep> timing() const override { return here_ ? here_->timing() : std::vector<TimedStep>(); }
  const SourceRange& origin() const override { return origin_; }
  std::vector<NamedNode> named_nodes() const override { return request_.choices.chain_nodes; }

 private:
  // Another machine.
  struct Part {
    std::unique_ptr<MachineRecorder> recorder;
    std::string request;
    std::string there;  // the directory of the recording on the machine
    bool begun = false;
    bool fetching = false;
    tracing::MachinePart result = {};
  };

  std::string session() const {
    return !session_.empty() ? session_ : here_ ? here_->config().session_name : request_.config.session_name;
  }
  std::string directory() const { return request_.config.base_path + "/" + session(); }
  bool takes_snapshots() const { return request_.config.records_snapshots(); }
  void begin_snapshots();
  void take_request();
  void want_by_event(const std::string& reason);  // of this machine
  void want_of(const std::string& machine, const MachineRecorder::Reason& reason);
  void end_sessions();
  void finish_snapshots();
  std::string make_page() const;
  void tell_page(const std::string& page);
  std::vector<tracing::MachinePart> unrecorded() const;
  bool is_to_be_recorded(const ProcessSpec& spec) const;
  void add_part(const std::string& machine, const std::vector<ProcessSpec>& processes);
  void note(const std::exception_ptr& error);
  void on_begun();
  void undo();
  void end_of_this_machine_alone();
  void fail_on_loss(bool complete);
  void on_ended(Part& part, const MachineRecorder::Outcome& outcome);
  void on_fetched(Part& part, const MachineRecorder::Outcome& outcome);
  // Tells now and then how much of the recordings has come.
  void watch_fetching();
  void finish();
  // The chains; and in the verdict what counts until the recordings are here.
  void write_what_is_known();
  std::vector<tracing::MachinePart> results() const;
  // Calls `next` when so many things are done. finished_one() tells of each.
  void wait_for(std::size_t count, std::function<void()> next);
  void finished_one();

  TraceRequest request_;
  std::unique_ptr<TraceScope> here_;
  MachineRecorders* recorders_;
  Settings settings_;
  SourceRange origin_;
  std::string session_;  // its name, once that of this machine has a folder
  UniqueFd name_;        // claims that of the session, if this machine is not recorded
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<std::string> warnings_;
  EventLoop* loop_ = nullptr;
  Tell tell_;
  Completion done_;
  std::exception_ptr error_;
  bool here_begun_ = false;
  bool hurried_ = false;
  std::size_t pending_ = 0;
  std::function<void()> next_;
  std::thread worker_;
  EventLoop::SourcePtr fetching_;
  SnapshotObserver snapshot_observer_;
  EventLoop::SourcePtr snapshot_signal_;  // if this machine is not recorded
  UniqueFd snapshot_requests_;            // those by hand
  EventLoop::SourcePtr snapshot_requests_source_;
  std::unique_ptr<SnapshotRounds> snapshots_;
  mutable std::set<std::string> used_;                                // machines where a process was to be recorded
  mutable std::map<std::string, std::vector<std::string>> too_late_;  // processes of machines that are not recorded
};

}  // namespace launch
