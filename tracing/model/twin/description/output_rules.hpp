// SPDX-License-Identifier: Apache-2.0
// Decides which of its outputs a run of a callback sends, and how long it takes. The simulation and the stand-ins have
// it in common.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "tracing/model/twin/description/distribution.hpp"
#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

struct Run {
  std::int64_t time_ns = 0;
  bool is_silent = false;            // the time is one of `silent_run_times`
  std::uint32_t place = 0;           // of the time in that distribution
  std::vector<std::size_t> outputs;  // indices in Callback::outputs, in the order of `sent`
};

// Not to be used by two threads at once.
class OutputRules {
 public:
  // The system must outlive it.
  explicit OutputRules(const System& system);
  // With a time after the begin of the recording: as it was recorded then. Without it: at random.
  Run next_run(Index callback, std::optional<std::int64_t> time_ns = std::nullopt);

 private:
  struct Join {
    Index publisher = kNone;
    std::vector<Index> inputs;
    std::vector<bool> seen;  // by input
  };
  struct State {
    std::vector<std::uint64_t> runs;  // by output
    std::vector<std::size_t> joins;   // that this callback is an input of
    std::vector<Index> join_of;       // by output: index in joins_, or kNone
    std::vector<std::size_t> by_sent;
    Draw run_times;
    Draw silent_run_times;
  };

  // The joins that the run has completed.
  std::vector<std::size_t> complete(Index callback);

  const System& system_;
  std::mt19937_64 random_;
  std::vector<Join> joins_;
  std::vector<State> states_;  // by callback
};

}  // namespace tracing::twin
