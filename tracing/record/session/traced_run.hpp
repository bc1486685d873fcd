// SPDX-License-Identifier: Apache-2.0
// A trace session around the run of a system: its start, what is done beside recording while the system runs, its end.
//
// Call start(), then look_around() and request_snapshot() as you like, then finish(). start(), look_around() and
// finish() block, some for hundreds of milliseconds: call them from a thread of your own, one at a time. The others
// return at once, and request_snapshot(), process_started(), process_ended() and hurry() may be called from any thread
// meanwhile.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/record/account/counters/counter_directory.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/overhead_guard.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/event_watch.hpp"
#include "tracing/record/session/flight_recorder.hpp"
#include "tracing/record/session/run_watch.hpp"
#include "tracing/record/session/tracer.hpp"

namespace tracing {

// What a run wants of its trace beside the recording itself.
struct RunChoices {
  // Reasons for a snapshot: a process dies unasked, the owner of the run gets this signal (0: none), an event matches.
  bool snapshot_on_crash = false;
  int snapshot_on_signal = 0;
  std::vector<std::string> snapshot_on_events = {};
  // Further reasons: a callback takes longer, or a message is older, than so many milliseconds; 0: no such reason.
  double callback_deadline = 0;
  double message_deadline = 0;
  bool report = false;                       // a page is made of the trace at its end
  std::vector<ChainDefinition> chains = {};  // for the report

  bool flight_recorder() const { return snapshot_on_crash || snapshot_on_signal != 0 || !watched_events().empty(); }
  // The events that cause a snapshot.
  std::vector<std::string> watched_events() const;
};

// The reasons for a snapshot that events give.
std::vector<std::string> reasons_by_events(const RunChoices& choices);
// The names of the events whose rules are among the reasons.
std::vector<std::string> late_events(const RunChoices& choices, const std::vector<std::string>& reasons);

class TracedRun {
 public:
  // Tells something to the user; called from several threads.
  using Tell = std::function<void(bool warning, const std::string& text)>;
  // Called from a thread of its own for each snapshot that was taken. `late` names the events by which processes have
  // told that they missed a deadline, if that is a reason.
  using SnapshotObserver = std::function<void(const TakenSnapshot& taken, const std::vector<std::string>& late)>;

  // `prefix` is the folder of bin/launch, which ends the session of a killed launcher, and lib/launch/launch-report,
  // which describes a finished trace in one line and as a page.
  TracedRun(TraceConfig config, std::unique_ptr<Tracer> tracer, std::string prefix, RunChoices choices);

  // The evaluated settings. They may be changed before start().
  TraceConfig& config() { return config_; }
  const TraceConfig& config() const { return config_; }
  const RunChoices& choices() const { return choices_; }
  const std::string& prefix() const { return prefix_; }
  // The libraries that every traced process preloads.
  const std::vector<std::string>& preload() const { return preload_; }
  // Where processes count their events; null before clean_up_command(), and when there is no room.
  const CounterDirectory* counters() const { return counters_.get(); }
  // Called from several threads, from start() to finish(), when there is a reason for a snapshot; `died` as of
  // FlightRecorder::request().
  using SnapshotWish = std::function<void(const std::string& reason, const std::string& died)>;
  // The owner of the run decides when snapshots are taken, by take_snapshot(), and writes the chains. The run only
  // passes on the reasons, and removes no snapshot. Call it before start().
  void leave_snapshots_to(SnapshotWish wish) { wish_ = std::move(wish); }
  // Adds a warning that start() tells. Call it before.
  void warn(std::string warning) { setup_.warnings.push_back(std::move(warning)); }

  // The command that releases what start() takes when this process is killed before finish(). Call it once, before
  // start(), and only if there will be a run: it makes the directory of counters, and chooses the name of a session
  // that has a time stamp.
  std::vector<std::string> clean_up_command();

  // Begins the session, its flight recorder and the guard of max-overhead. Throws TraceError; nothing is left then.
  void start(const Tell& tell, const SnapshotObserver& observer);
  // To be called once when the processes of the run have registered: it has the events described early, which saves
  // 200 ms at the end of the session (programs/trace_probe/trace_probe.c), and warns of programs that can't be
  // recorded, for which it searches all of /proc.
  void look_around(const Tell& tell);
  // Does nothing if there is no flight recorder at the time. `died`: as of FlightRecorder::request().
  void request_snapshot(const std::string& reason, const std::string& died = "");
  // Takes one now, of a session of snapshots that has begun. Blocks; not after finish() has begun.
  TakenSnapshot take_snapshot(SnapshotOrder order) const { return tracing::take_snapshot(config_, std::move(order)); }
  // A process of the run has begun, in the trace or not.
  void process_started(pid_t pid);
  // A process of the run has ended just now: find out whether it has died within an event, at once or at the end.
  // `died`: not with exit code 0.
  void process_ended(const std::string& name, pid_t pid, bool died);
  // The user is in a hurry: a finish() under way ends at once, with the data that is there.
  void hurry() { hurry_ = true; }
  // Ends the session and tells what it holds and has lost. Throws TraceError when the session can't be reached any
  // more, and for losses if the settings want that (fail_on_loss).
  void finish(const Tell& tell);

  // The steps of start(); after finish(), those of finish().
  bool finished() const { return !losses_.steps.empty(); }
  const std::vector<SessionStep>& steps() const { return finished() ? losses_.steps : setup_.steps; }

 private:
  // Ends a session that has begun although its setup failed.
  void end_failed_session();
  // Returns a sentence if it fails.
  std::string write_chains() const;
  void start_flight_recorder(const Tell& tell, const SnapshotObserver& observer);
  void stop_flight_recorder();
  void stop_run_watch();
  void summarize();
  void make_report();
  bool has_no_snapshot() const;
  void tell_result(const Tell& tell) const;

  TraceConfig config_;
  std::unique_ptr<Tracer> tracer_;
  std::string prefix_;
  RunChoices choices_;
  std::int64_t created_;   // when this run was made, in seconds since the epoch
  launch::UniqueFd name_;  // claims that of the session, if it has a time stamp
  std::vector<std::string> preload_;
  std::shared_ptr<CounterDirectory> counters_;
  SetupReport setup_;
  LossAccount losses_;
  std::string summary_;
  std::string report_;  // path of the page; empty: none could be made
  std::atomic<bool> hurry_ = false;
  std::mutex watchers_mutex_;  // of the pointers to the flight recorder and to the watch of the run
  std::shared_ptr<FlightRecorder> flight_recorder_;
  SnapshotWish wish_;
  std::unique_ptr<EventWatch> event_watch_;
  std::unique_ptr<OverheadGuard> overhead_guard_;
  std::unique_ptr<RunWatch> run_watch_;
};

}  // namespace tracing
