// SPDX-License-Identifier: Apache-2.0
// Finds out that the launcher does not take the signals that ask it to end: its loop is blocked, for example by Python
// code of a launch file that never returns.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "launcher/process/guardian/inherited_mark.hpp"

namespace launch {

// The launcher blocks these signals and reads them in its loop. A signal that stays pending has not been read. A
// launcher that is stopped is continued before it is asked to end, so one that stays stopped is blamed, too. One that a
// debugger from outside of the launch holds is not, until the user has asked three times.
class UnansweredSignals {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{10};

  // With the mark of the launch, what has it does not count as outside, also where it does not descend from this
  // process.
  explicit UnansweredSignals(pid_t launcher, InheritedMark mark = {}) : launcher_(launcher), mark_(mark) {}

  // True when a signal has been pending for kPatience. Looks into /proc, so call it after a signal has come and when
  // next_look() has passed.
  bool over();
  // A user has asked once more. What comes within a second is the same wish.
  void count();
  // "the launcher has not answered a signal for 10 s, so something in it is blocked"
  std::string reason() const;
  // How long to wait before the next look, as poll(2) wants it: milliseconds, or -1 when nothing is asked.
  int next_look() const { return pending_since_ || counted_ ? 500 : -1; }

 private:
  pid_t launcher_;
  InheritedMark mark_;
  std::optional<Clock::time_point> pending_since_;
  std::optional<Clock::time_point> counted_;
  int wishes_ = 0;
  bool held_ = false;  // stopped or traced
};

}  // namespace launch
