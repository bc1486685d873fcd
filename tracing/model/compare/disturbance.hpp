// SPDX-License-Identifier: Apache-2.0
// What the machine delays callbacks by, as far as a run tells. Such a delay may always hit the same callback, so it is
// part of what two runs differ by. A quantity that has changed is never asked about itself: its change would count as a
// delay, and so hide itself.
#pragma once

#include <map>
#include <string>

#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

// What the durations of a callback in a run tell.
struct CallbackTimes {
  // How far they lie apart: from the 10th to the 90th percentile, as the logarithm of a ratio. The lengths of the
  // callback's own work are in it, too.
  double spread = 0;
  double median_ns = 0;
};

using Disturbances = std::map<std::string, CallbackTimes>;  // by subject

Disturbances disturbances_of(const RunSummary& run);

// What the machine delays callbacks by in one of two runs, the one that was disturbed more: what a fifth of the
// callbacks of a run exceeds.
struct Disturbance {
  double ratio = 0;     // its logarithm
  bool by_few = false;  // a run has fewer than kLeastPeers others, so the run before counts with all its callbacks
  // Of the other callbacks' median durations: the longest one, and the sum of the longest two; in the run where they
  // are less, so that a change makes them no longer.
  double longest_ns = 0;
  double longest_two_ns = 0;
};

// For `self`, a quantity of both runs. Others are all callbacks but `self`, and if it is a chain, but its steps.
Disturbance disturbance_between(const Disturbances& before, const Disturbances& after, const Measurement& self);

}  // namespace tracing::compare
