// SPDX-License-Identifier: Apache-2.0
// Python in a launch that runs. There it has no process of its own: its handlers and functions are called until the
// end, and act on processes of the launcher. So the launcher notes where Python is, in memory that launch-guardian
// reads when the launcher has gone: what Python ends is no silent end (python_at_work.hpp).
//
// A call has a limit of time if the user gives one. Expressions always have one, and one of memory. A limit of memory
// for launch files would be inherited by what they start.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/files/unique_fd.hpp"
#include "base/processes/python_at_work.hpp"

namespace launch {

struct WatchedRun {
  PythonAtWork* memory = nullptr;  // that the guardian reads
  UniqueFd traces;                 // where Python writes its stack when it ends this process
  int own_descriptor = -1;         // of the launcher: when it has gone, so have others
  // How long a call of a launch file may take; nullopt: as long as it likes.
  std::optional<std::chrono::seconds> call_limit;
  std::chrono::seconds expression_limit{60};
  std::uint64_t expression_memory = 2ULL << 30U;  // bytes, beyond what the launcher has when Python starts
};

// From now on calls of Python are noted. Call it once, before Python is used, and not in a process that makes a guest.
void watch_python_of_a_run(WatchedRun run);

// Python is there: `report_deaths` is called with the descriptor for the traces, the first time.
void python_has_started(void (*report_deaths)(int descriptor));

// The launcher ends by itself.
void end_of_watched_run();

// How long a $(command …) of the run may take.
std::optional<std::chrono::seconds> watched_call_limit();

// Where an expression stands. Without a line: a launch file in Python.
struct PythonPlace {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

// For the time of its life Python runs for this place. Calls nest. Without a watched run it does nothing. At the end,
// standard descriptors that Python has closed lead to /dev/null; if it has closed those of the launcher, the launcher
// ends, and the guardian tells why.
class WatchedCall {
 public:
  explicit WatchedCall(PythonPlace place);
  WatchedCall(const WatchedCall&) = delete;
  WatchedCall& operator=(const WatchedCall&) = delete;
  ~WatchedCall();

 private:
  PythonPlace outer_;
};

}  // namespace launch
