// SPDX-License-Identifier: Apache-2.0
// A trace of another machine, as a scope of the launch sees it. All callbacks come in later turns of the loop, once
// each.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace launch {

class MachineRecorder {
 public:
  struct Outcome {
    bool well = true;
    bool lost = false;  // the connection to the machine is lost
    std::string error;  // one line
    std::string help;
    std::string directory;  // of begin() and end(): where the recording is on the machine; empty: there is none
  };
  using Done = std::function<void(const Outcome&)>;

  virtual ~MachineRecorder() = default;

  virtual const std::string& machine() const = 0;
  // Begins a session there. `request`: a MachineTrace as bytes. Warnings of the session go to `warn`, until the end.
  virtual void begin(const std::string& request, std::function<void(const std::string& text)> warn, Done done) = 0;
  // Ends it, if it has begun. `nothing_to_record`: no process ran there that was to be recorded.
  virtual void end(bool nothing_to_record, Done done) = 0;
  // An end or a fetch under way must be done soon, with the data that is there.
  virtual void hurry() = 0;
  // After end(): copies the recording into this directory, which must not exist, and makes sure that it is the same.
  // After an error nothing is left of the copy.
  virtual void fetch(const std::string& directory, Done done) = 0;
  // So many bytes have come so far.
  virtual std::uint64_t fetched() const = 0;
  // Nothing more is wanted. The recording there stays, or is removed.
  virtual void leave(bool remove) = 0;
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
