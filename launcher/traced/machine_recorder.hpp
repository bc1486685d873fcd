// SPDX-License-Identifier: Apache-2.0
// A trace of another machine, as a scope of the launch sees it. All callbacks come in later turns of the loop, once
// each.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tracing/record/session/flight_recorder.hpp"

namespace launch {

// What is recorded on a machine, and can be had from there.
class MachineRecording {
 public:
  struct Outcome {
    bool well = true;
    bool lost = false;  // the connection to the machine is lost
    std::string error;  // one line
    std::string help;
    std::string directory;  // where the recording is on the machine; empty: there is none, or fetch() has answered
  };
  using Done = std::function<void(const Outcome&)>;

  virtual ~MachineRecording() = default;

  // What is under way must be done soon, with the data that is there.
  virtual void hurry() = 0;
  // Copies the recording into this directory, which must not exist, and makes sure that it is the same. After an error
  // nothing is left of the copy. Call it when there is a recording.
  virtual void fetch(const std::string& directory, Done done) = 0;
  // So many bytes have come so far.
  virtual std::uint64_t fetched() const = 0;
  // Nothing more is wanted. The recording there stays, or is removed. Call it when the recording has ended, well or
  // not.
  virtual void leave(bool remove) = 0;
};

class MachineRecorder : public MachineRecording {
 public:
  // A reason for a snapshot.
  struct Reason {
    enum class Kind { kEvent, kEndOfProcess, kLost };

    Kind kind = Kind::kEvent;
    std::string text = {};  // of an event: the reason; of a process: its label
    std::int32_t code = 0;  // of a process: its exit code, -N for signal N
  };
  // A machine may say anything: whether it is a reason of the trace is not known here.
  using Wish = std::function<void(const Reason& reason)>;

  virtual const std::string& machine() const = 0;
  // By how much the wall clock there is ahead of the one here, in nanoseconds, from begin() on; 0: it can't be told.
  virtual std::int64_t clock_ahead() const = 0;
  // Begins a session there. `request`: a MachineTrace as bytes. Warnings of the session go to `warn`, until the end. A
  // session of snapshots takes none by itself: it tells `wish` of the reasons.
  virtual void begin(const std::string& request, std::function<void(const std::string& text)> warn, Wish wish,
                     Done done) = 0;
  // Takes a snapshot, when the session has begun. `order.moment` is of the clock of this machine; the machine gets it
  // by its own. `done` has the directory of the snapshot, which is a recording like any other.
  virtual std::unique_ptr<MachineRecording> take_snapshot(tracing::SnapshotOrder order, Done done) = 0;
  // Ends it, if it has begun, and no snapshot is being taken. `nothing_to_record`: no process ran there that was to be
  // recorded.
  virtual void end(bool nothing_to_record, Done done) = 0;
};

// Those of the machines that a launch is connected to.
class MachineRecorders {
 public:
  virtual ~MachineRecorders() = default;
  // The machines that the launch uses and has not lost.
  virtual std::vector<std::string> connected() const = 0;
  // For one trace of the machine. Null if there was never a connection to it.
  virtual std::unique_ptr<MachineRecorder> recorder(const std::string& machine) = 0;
};

}  // namespace launch
