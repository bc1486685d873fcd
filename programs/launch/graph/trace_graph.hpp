// SPDX-License-Identifier: Apache-2.0
// `launch graph --from-trace` and `--live`: the graph that a trace shows. Other programs record and read the trace.
#pragma once

#include <string>

namespace launch {

struct TraceToDraw {
  std::string directory;  // of a trace; empty: record what runs now
  double seconds = 0;     // how long to record
  bool as_picture = false;
  std::string output;  // a file; empty: standard output
};

// Has `launch report` draw the graph. Without a directory it records what runs into a temporary one first: processes
// that run already record their nodes and topics again when a session starts. Returns the exit code.
int draw_trace(const TraceToDraw& trace);

}  // namespace launch
