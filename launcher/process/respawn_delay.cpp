// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/respawn_delay.hpp"

#include <algorithm>

namespace launch {

Duration RespawnDelay::next(const RespawnPolicy& policy, Duration ran_for) {
  if (policy.backoff <= 1.0) {
    return policy.delay;
  }
  if (next_ == Duration{0} || ran_for > policy.max_delay) {
    next_ = policy.delay;
  }
  const Duration delay = std::min(next_, policy.max_delay);
  // Compared as seconds: the product may be too large for a Duration.
  using Seconds = std::chrono::duration<double>;
  const Seconds longer = Seconds(delay) * policy.backoff;
  next_ = longer < Seconds(policy.max_delay) ? std::chrono::duration_cast<Duration>(longer) : policy.max_delay;
  return delay;
}

}  // namespace launch
