// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/unanswered_signals.hpp"

#include <signal.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

// What stands behind `key` in /proc/PID/status, proc(5).
const char* value_of(const std::string& status, std::string_view key) {
  const std::size_t found = status.find(key);
  return found == std::string::npos ? "" : status.c_str() + found + key.size();
}

bool has_pending_request(pid_t process) {
  const std::string status = read_proc_file(process, "status");
  const char state = *value_of(status, "\nState:\t");
  if (state == 'T' || state == 't') {
    return false;
  }
  std::uint64_t requests = 0;
  for (const int signal : kEndingSignals) {
    requests |= std::uint64_t{1} << (signal - 1);
  }
  const std::uint64_t pending = std::strtoull(value_of(status, "\nSigPnd:\t"), nullptr, 16) |
                                std::strtoull(value_of(status, "\nShdPnd:\t"), nullptr, 16);
  return (pending & requests) != 0;
}

}  // namespace

bool UnansweredSignals::over() {
  if (!has_pending_request(launcher_)) {
    pending_since_.reset();
    return false;
  }
  const Clock::time_point now = Clock::now();
  if (!pending_since_) {
    pending_since_ = now;
  }
  return now - *pending_since_ >= kPatience;
}

}  // namespace launch
