// SPDX-License-Identifier: Apache-2.0
// Puts what the launcher does into the traces of the run: liblaunch_trace.so, opened when the first session records.
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "launcher/visit/launch_record.hpp"
#include "tracing/launch_provider/launch_provider.h"

namespace launch {

class LaunchTracepoints : public LaunchRecorder {
 public:
  // The library is in lib/launch below `prefix`. If it is missing, nothing is recorded, and nothing else changes.
  explicit LaunchTracepoints(std::string prefix) : prefix_(std::move(prefix)) {}
  ~LaunchTracepoints() override { end(); }

  // Opens the library in a thread of its own. Opening takes some milliseconds, because LTTng-UST waits until the
  // session daemon has told it which events are enabled.
  void begin() override;
  void drop() override;
  void record(LaunchRecord record) override;
  void end() override;

 private:
  enum class State { kKeeping, kDropping, kOpening, kOpen };

  void open();

  std::string prefix_;
  std::thread opener_;
  std::mutex mutex_;  // guards the members below
  State state_ = State::kKeeping;
  std::vector<LaunchRecord> kept_;
  launch_trace_fire_function fire_ = nullptr;
};

}  // namespace launch
