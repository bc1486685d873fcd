// SPDX-License-Identifier: Apache-2.0
// What is kept of a run to compare it with others, as plain data of bounded size.
#pragma once

#include "tracing/model/analysis/results/field.hpp"

namespace tracing::compare {

enum class Kind { kCallback, kHop, kChain, kCall };

// In the order of Kind.
inline constexpr const char* kKindNames[] = {"callback", "hop", "chain", "call"};

constexpr const char* kind_name(Kind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

inline constexpr const char* kDuration = "duration";  // of a callback
// Parts of it, from events of the kernel's scheduler.
inline constexpr const char* kRunning = "running";
inline constexpr const char* kWaiting = "waiting for a processor";
inline constexpr const char* kBlocked = "blocked";

// Behind the quantity: of the runs of a callback that sent nothing, where others of it did.
inline constexpr const char* kWithoutSending = " without sending";

// One quantity of one subject. Kind, subject and quantity together name it in every run: they hold no process numbers
// and no addresses.
struct Measurement {
  Kind kind = Kind::kCallback;
  // "/sensor, timer 10 ms"; "/scan to /filter"; "/sensor (timer 10 ms) -> /filter (/scan)"; "/add, asked by /client".
  // A second one with the same name has " #2" at the end.
  std::string subject;
  std::string quantity;               // "duration", "interval", "running", "latency", "response", …
  std::vector<std::string> steps;     // of a chain: the subjects of its callbacks
  std::uint64_t count = 0;            // of all samples
  std::vector<std::int64_t> samples;  // nanoseconds, in the order of time; KeptSamples::kMost at most
  bool doubtful = false;              // events of its process may be missing
  // Which publication its messages are is an estimate (MessageFlow::is_estimated).
  bool estimated = false;
  // Of the durations of a callback: whether it sent messages in these runs of it. What it does then is other work: a
  // fusion sends when the last of its inputs comes, and which one that is differs from run to run. Nullopt: of all runs
  // of it, in baselines of former releases and where its process sends nothing.
  std::optional<bool> sends = std::nullopt;
  // Of a chain: somewhere a message waits in a node for a timer or for other messages.
  bool waits = false;
};

struct RunSummary {
  std::string directory;      // of the trace
  std::int64_t begin_ns = 0;  // 0: no event
  std::int64_t duration_ns = 0;
  std::uint64_t events = 0;
  std::string remark;                     // "37 events lost", why reading stopped early
  std::vector<Measurement> measurements;  // by kind, subject, quantity

  static const Field<RunSummary> kFields[];
};
inline constexpr Field<RunSummary> RunSummary::kFields[] = {
    {"directory", &RunSummary::directory, ""},
    {"begin_ns", &RunSummary::begin_ns, "since the epoch", trait::kTime},
    {"duration_ns", &RunSummary::duration_ns, ""},
    {"events", &RunSummary::events, ""},
    {"remark", &RunSummary::remark, "why the trace is incomplete; empty if it is complete"},
};

// One side of a comparison: a trace, or a baseline with one or several runs.
struct Runs {
  std::string source;  // directory or file
  std::vector<RunSummary> runs;
};

}  // namespace tracing::compare
