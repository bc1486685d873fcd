// SPDX-License-Identifier: Apache-2.0
// Snapshots of all machines of a launch for the same moment. Whatever machine has the reason, all are told to take one
// now; their buffers still hold what was before. What they have written comes home, into one directory with a folder
// for each machine and one verdict. While snapshots come home, others can be taken. All is done in the loop's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "actions/trace/trace_scope.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/traced/machine_recorder.hpp"
#include "launcher/traced/snapshot_socket.hpp"
#include "launcher/visit/run_scope.hpp"
#include "tracing/record/account/machines_verdict.hpp"

namespace launch {

class SnapshotRounds {
 public:
  struct Settings {
    std::string directory;  // of the trace: each snapshot has a directory in it
    std::string session;
    std::size_t limit = 10;  // so many snapshots are kept, the newest ones
    bool collects = true;    // what other machines have written comes home; else it stays there
    // Whether a process of the machine was to be recorded; else it is no problem that it has no snapshot. Null: all
    // have some.
    std::function<bool(const std::string& machine)> is_used = {};
  };
  // To somebody who has asked for a snapshot by hand.
  using Answer = std::function<void(const SnapshotAnswer&)>;
  // The machines that are not recorded, for the verdict.
  using Unrecorded = std::function<std::vector<tracing::MachinePart>()>;

  // `here` is null if this machine is not recorded. The session has begun on it and on the machines, which must outlive
  // this object, as the loop must.
  SnapshotRounds(EventLoop& loop, Settings settings, TraceScope* here, std::vector<MachineRecorder*> machines,
                 RunScope::Tell tell, RunScope::SnapshotObserver observer, Unrecorded unrecorded);
  ~SnapshotRounds();
  SnapshotRounds(const SnapshotRounds&) = delete;
  SnapshotRounds& operator=(const SnapshotRounds&) = delete;

  // A reason, which is kept once until the snapshot begins. `died`: the process whose end it is, on that machine; ""
  // if it is none. `late`: the events that have told it.
  struct Wish {
    std::string reason;
    std::string machine = {};
    std::string died = {};
    std::vector<std::string> late = {};
    Answer answer = {};  // by hand
  };
  void want(Wish wish);
  // Nothing more is wanted. `done` follows when all that was wanted has been taken, and is here or is told to be
  // missing.
  void end(std::function<void()> done);
  // What is under way ends soon; what has not come is left where it is.
  void hurry();

  std::size_t taken() const { return numbers_; }

 private:
  struct Part;
  struct Round;

  void begin_next();
  void take_here(Round& round);
  void take_there(Round& round, Part& part);
  // A machine has none, because of that.
  void has_none(Part& part, const std::string& problem) const;
  void one_taken(Round& round);
  void taken(Round& round);
  void fetch_next();
  void one_fetched(Round& round);
  // Tells now and then how much has come.
  void watch_fetching();
  void finish(Round& round);
  bool write_verdict(const Round& round);
  void drop(Round& round);
  void keep_newest();
  void check_end();

  EventLoop& loop_;
  Settings settings_;
  TraceScope* here_;
  std::vector<MachineRecorder*> machines_;
  RunScope::Tell tell_;
  RunScope::SnapshotObserver observer_;
  Unrecorded unrecorded_;
  std::shared_ptr<bool> lives_ = std::make_shared<bool>(true);
  std::vector<Wish> wanted_;
  std::int64_t moment_ = 0;  // of the first of them (CLOCK_MONOTONIC, ns)
  std::size_t numbers_ = 0;
  std::unique_ptr<Round> taking_;
  std::deque<std::unique_ptr<Round>> waiting_;  // taken; the first one is being fetched
  std::deque<std::unique_ptr<Round>> kept_;     // from the oldest
  EventLoop::SourcePtr fetching_;
  bool hurried_ = false;
  bool closed_ = false;
  std::function<void()> ended_;
};

}  // namespace launch
