// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/blocked_probe.hpp"

#include <fmt/format.h>

#include "launcher/health/processor_wait.hpp"

namespace launch {

Look BlockedProbe::look(Duration, Duration passed) {
  const char state = state_of_thread(pid_, pid_, proc_);
  if (state == '?') {
    return {};  // it ends
  }
  if (state == 't') {
    age_ = Duration{0};
    return {.note = "a debugger holds it: whether it is blocked is not judged"};
  }
  if (state != 'T' && state != 'D') {
    state_ = state;
    age_ = Duration{0};
    return {Look::Result::kGood};
  }
  age_ = state == state_ ? age_ + passed : passed;
  state_ = state;
  if (age_ < timeout_) {
    return {};
  }
  return {Look::Result::kBad,
          fmt::format("it {} for {:.1f} s", state == 'T' ? "has been stopped by a signal" : "has hung in the kernel",
                      std::chrono::duration<double>(age_).count())};
}

}  // namespace launch
