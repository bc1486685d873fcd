// SPDX-License-Identifier: Apache-2.0
// The steps of the launcher itself and their times, for a trace of the run: LTTng provider `launch`.
#pragma once

#include <cstdint>
#include <string>

#include "base/diagnostics/source.hpp"

namespace launch {

struct LaunchRecord {
  enum class Kind {
    kLoad,        // a launch file was read and checked, name: its path
    kInclude,     // another launch file was visited, name: its path
    kVisit,       // the launch file, or the children of a timer, were visited
    kReady,       // the condition of a process holds, name: the process, what: the condition, where: the depends_on
    kSpawn,       // a process is about to be started, name: its label, as for all below
    kExec,        // its program runs
    kExit,        // it ended, value: its exit code, -N for signal N
    kRespawn,     // it ended and will be started again
    kSignal,      // a signal was sent to its group, value: the signal
    kScheduling,  // its threads get processors in another way, what: which one; empty: as before
    kCondition    // a condition on what nodes do, name: itself, what: how it has changed
  };

  Kind kind = Kind::kVisit;
  std::string name = {};
  std::string what = {};   // ready, scheduling, condition
  SourceRange where = {};  // the line that asked for it; may be empty
  std::int32_t pid = 0;
  std::int32_t value = 0;
  bool asked_for = false;     // exit: a signal of the launcher or its shutdown came before
  std::int64_t time = 0;      // monotonic_time(), of the beginning if it took a while
  std::int64_t duration = 0;  // nanoseconds: load, include, visit
};

// The receiver of records. All calls come from the loop's thread and must not block it, except end().
class LaunchRecorder {
 public:
  virtual ~LaunchRecorder() = default;

  // A session records from now on: earlier records follow at once, with the times at which their steps happened.
  virtual void begin() = 0;
  // No session will record: the kept records are dropped.
  virtual void drop() = 0;
  virtual void record(LaunchRecord record) = 0;
  // Returns when everything has been handed over, before the sessions end.
  virtual void end() = 0;
};

}  // namespace launch
