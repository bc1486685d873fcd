// SPDX-License-Identifier: Apache-2.0
// Which machine and which session a trace comes from.
#pragma once

#include <string>

namespace tracing {

// Process ids of recordings that differ have nothing to do with each other.
struct Recording {
  std::string host;     // name of the machine; empty: not recorded
  std::string machine;  // identity of the clock, which is that of one boot of one machine; empty: not recorded
  // Equal for the traces of one session: its userspace and kernel traces, its snapshots and chunks, and the two halves
  // of a dual session.
  std::string session;
  bool of_kernel = false;  // written by a tracer of the kernel, which sees the processes of all sessions

  bool operator==(const Recording&) const = default;
};

// What the metadata of a trace say. An empty text is an entry that is not there.
struct RecordingFacts {
  std::string hostname;
  std::string domain;
  std::string trace_name;  // of the session
  std::string trace_creation_datetime;
  std::string clock_uuid;
  std::string trace_uuid;
};

Recording recording_of(const RecordingFacts& facts);

}  // namespace tracing
