// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/respawn_delay.hpp"

#include <algorithm>

namespace launch {

Duration RespawnDelay::next(const RespawnPolicy& policy, Duration ran_for) {
  if (policy.backoff <= 1.0) {
    return policy.delay > Duration{0} ? policy.delay : delay_of_short_runs(ran_for);
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

Duration RespawnDelay::delay_of_short_runs(Duration ran_for) {
  constexpr Duration kShort = std::chrono::seconds(1);
  constexpr Duration kFirst = std::chrono::milliseconds(100);
  constexpr Duration kLongest = std::chrono::seconds(5);
  short_runs_ = ran_for < kShort ? short_runs_ + 1 : 0;
  if (short_runs_ < kShortRuns) {
    return Duration{0};
  }
  next_ = short_runs_ == kShortRuns ? kFirst : std::min(next_ * 2, kLongest);
  return next_;
}

}  // namespace launch
