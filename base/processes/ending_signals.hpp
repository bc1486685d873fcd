// SPDX-License-Identifier: Apache-2.0
// Signals that end programs: those by which a user, a shell or a terminal asks for it, and those of a mistake of the
// program. SIGKILL is not among them: no program sees it.
#pragma once

#include <signal.h>

#include <algorithm>
#include <array>

namespace launch {

inline constexpr std::array<int, 4> kEndingSignals = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

constexpr bool asks_to_end(int signal) {
  return std::find(kEndingSignals.begin(), kEndingSignals.end(), signal) != kEndingSignals.end();
}

inline constexpr std::array<int, 7> kCrashSignals = {SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE, SIGSYS, SIGTRAP};

constexpr bool tells_of_a_crash(int signal) {
  return std::find(kCrashSignals.begin(), kCrashSignals.end(), signal) != kCrashSignals.end();
}

}  // namespace launch
