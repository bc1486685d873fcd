// SPDX-License-Identifier: Apache-2.0
// The time between an exit and the next start: always the same, or longer after each run that was short.
#pragma once

#include "launcher/process/process_spec.hpp"

namespace launch {

class RespawnDelay {
 public:
  // The delay before the next start, after a run of this length (0 for a start that failed).
  Duration next(const RespawnPolicy& policy, Duration ran_for);
  // Begins the series anew.
  void reset() { next_ = Duration{0}; }

 private:
  Duration next_{0};  // 0: the delay of the policy
};

}  // namespace launch
