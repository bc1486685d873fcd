// SPDX-License-Identifier: Apache-2.0
// The signals by which a user, a shell or a terminal asks a program to end. SIGKILL is not among them: no program sees
// it.
#pragma once

#include <signal.h>

#include <algorithm>
#include <array>

namespace launch {

inline constexpr std::array<int, 4> kEndingSignals = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

constexpr bool asks_to_end(int signal) {
  return std::find(kEndingSignals.begin(), kEndingSignals.end(), signal) != kEndingSignals.end();
}

}  // namespace launch
