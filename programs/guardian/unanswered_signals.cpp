// SPDX-License-Identifier: Apache-2.0
#include "programs/guardian/unanswered_signals.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/processes/ending_signals.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

// What stands behind `key` in /proc/PID/status, proc(5).
const char* value_of(const std::string& status, std::string_view key) {
  const std::size_t found = status.find(key);
  return found == std::string::npos ? "" : status.c_str() + found + key.size();
}

constexpr int kWishes = 3;  // of a user who can't wait
constexpr std::chrono::seconds kSameWish{1};

bool is_held(const std::string& status) {
  const char state = *value_of(status, "\nState:\t");
  return state == 'T' || state == 't';
}

bool is_traced(const std::string& status) {
  return *value_of(status, "\nState:\t") == 't';
}

// By a process that neither descends from this one nor has the mark.
bool is_traced_from_outside(const std::string& status, const InheritedMark& mark) {
  const auto tracer = static_cast<pid_t>(std::strtol(value_of(status, "\nTracerPid:\t"), nullptr, 10));
  if (tracer == 0 || mark.is_on(tracer)) {
    return false;
  }
  const std::vector<FoundProcess> below = descendants(all_processes(), {::getpid()});
  return std::none_of(below.begin(), below.end(), [tracer](const auto& process) { return process.pid == tracer; });
}

bool has_pending_request(const std::string& status) {
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
  const std::string status = read_proc_file(launcher_, "status");
  // One that has taken a signal can be traced before it does what the signal asks for.
  if (!has_pending_request(status) && !(counted_ && is_traced(status))) {
    pending_since_.reset();
    wishes_ = 0;  // it has taken them
    return false;
  }
  const Clock::time_point now = Clock::now();
  if (!pending_since_) {
    pending_since_ = now;
  }
  held_ = is_held(status);
  if (held_ && wishes_ >= kWishes) {
    return true;
  }
  return now - *pending_since_ >= kPatience && !(held_ && is_traced_from_outside(status, mark_));
}

void UnansweredSignals::count() {
  const Clock::time_point now = Clock::now();
  if (!counted_ || now - *counted_ >= kSameWish) {
    counted_ = now;
    ++wishes_;
  }
}

std::string UnansweredSignals::reason() const {
  if (held_) {
    return "the launcher does not answer, because another process has stopped it";
  }
  return "the launcher has not answered a signal for " + std::to_string(kPatience.count()) +
         " s, so something in it is blocked";
}

}  // namespace launch
