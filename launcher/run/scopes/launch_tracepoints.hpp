// SPDX-License-Identifier: Apache-2.0
// Puts what the launcher does into the traces of the run: liblaunch_trace.so, opened when the first session records.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "launcher/visit/launch_record.hpp"
#include "tracing/record/launch_provider/launch_provider.h"

namespace launch {

class LaunchTracepoints : public LaunchRecorder {
 public:
  // The library is in lib/launch below `prefix`. If it is missing, nothing is recorded, and nothing else changes.
  explicit LaunchTracepoints(std::string prefix) : prefix_(std::move(prefix)) {}
  ~LaunchTracepoints() override { end(); }

  // Opens the library in a thread of its own. Opening takes some milliseconds, because LTTng-UST waits until the
  // session daemon has told it which events are enabled. On a busy machine that may take longer than LTTng-UST waits.
  // Records are kept until then.
  void begin() override;
  void drop() override;
  void record(LaunchRecord record) override;
  // Waits for some seconds at most until kept records can be fired.
  void end() override;

 private:
  enum class State { kKeeping, kDropping, kOpening, kOpen };

  void open();
  // When the session daemon has registered the launcher, or nobody waits for it any longer. The lock is held.
  void wait_until_enabled(std::unique_lock<std::mutex>& lock, launch_trace_enabled_function enabled);

  std::string prefix_;
  std::thread opener_;
  std::condition_variable ending_;
  std::mutex mutex_;  // guards the members below
  State state_ = State::kKeeping;
  bool end_ = false;
  std::vector<LaunchRecord> kept_;
  launch_trace_fire_function fire_ = nullptr;
};

}  // namespace launch
