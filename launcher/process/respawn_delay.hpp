// SPDX-License-Identifier: Apache-2.0
// The time between an exit and the next start: always the same, or longer after each run that was short.
//
// Without any delay, a program that ends at once would be started hundreds of times a second. After ten runs in a row
// of less than a second, the delay therefore grows from 0.1 s to 5 s, until a run lasts longer.
#pragma once

#include "launcher/process/process_spec.hpp"

namespace launch {

class RespawnDelay {
 public:
  // The delay before the next start, after a run of this length (0 for a start that failed).
  Duration next(const RespawnPolicy& policy, Duration ran_for);
  // Begins the series anew.
  void reset() { *this = {}; }
  // Whether the last delay was the first one of a series that the policy does not ask for.
  bool slows_down() const { return short_runs_ == kShortRuns; }

  static constexpr int kShortRuns = 10;

 private:
  Duration delay_of_short_runs(Duration ran_for);

  Duration next_{0};    // 0: the delay of the policy
  int short_runs_ = 0;  // in a row
};

}  // namespace launch
