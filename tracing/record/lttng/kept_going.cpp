// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/kept_going.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include "base/processes/process_stat.hpp"

namespace tracing {
namespace {

// Nobody tells of a process that goes on, but to its parent.
constexpr std::chrono::milliseconds kGoesInterval{1};
constexpr std::chrono::seconds kLongestStop{1};

std::atomic<int> keepers = 0;

}  // namespace

KeepsGoing::KeepsGoing() {
  ++keepers;
}

KeepsGoing::~KeepsGoing() {
  --keepers;
}

bool is_stopped(pid_t pid) {
  return launch::read_process_stat(pid).state == 'T';
}

bool is_kept_going(pid_t pid) {
  const auto latest = std::chrono::steady_clock::now() + kLongestStop;
  while (is_stopped(pid)) {
    if (keepers == 0 || std::chrono::steady_clock::now() > latest) {
      return false;
    }
    std::this_thread::sleep_for(kGoesInterval);
  }
  return true;
}

}  // namespace tracing
