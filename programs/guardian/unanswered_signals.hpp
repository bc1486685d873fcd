// SPDX-License-Identifier: Apache-2.0
// Finds out that the launcher does not take the signals that ask it to end: its loop is blocked, for example by Python
// code of a launch file that never returns.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>

namespace launch {

// The launcher blocks these signals and reads them in its loop. A signal that stays pending has not been read. A
// launcher that is stopped, by Ctrl-Z or a debugger, is not blamed.
class UnansweredSignals {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{10};

  explicit UnansweredSignals(pid_t launcher) : launcher_(launcher) {}

  // True when a signal has been pending for kPatience. Looks into /proc, so call it after a signal has come and when
  // next_look() has passed.
  bool over();
  // How long to wait before the next look, as poll(2) wants it: milliseconds, or -1 when nothing is pending.
  int next_look() const { return pending_since_ ? 500 : -1; }

 private:
  pid_t launcher_;
  std::optional<Clock::time_point> pending_since_;
};

}  // namespace launch
