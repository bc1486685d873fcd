// SPDX-License-Identifier: Apache-2.0
// Time that runs at a rate of its own, stands still and jumps, as faults of the clock want it.
#pragma once

#include <chrono>
#include <string_view>

namespace launch {

class SimulatedClock {
 public:
  using Real = std::chrono::steady_clock::time_point;
  using Seconds = std::chrono::duration<double>;

  SimulatedClock(Real now, double start, double rate) : since_(now), then_(start), rate_(rate) {}

  // Never negative.
  Seconds time(Real now) const;

  // "stop" and "go", which may be nested; "scale FACTOR" of the rate; "jump SECONDS". False for anything else.
  bool obey(std::string_view command, Real now);

 private:
  void hold(Real now);

  Real since_;
  Seconds then_;  // at since_
  double rate_;
  int stops_ = 0;
};

}  // namespace launch
