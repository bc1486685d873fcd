// SPDX-License-Identifier: Apache-2.0
// One line that says how far a launch is while it starts and while it stops: "starting 12 of 40", "stopping: 3 of 40
// still run, SIGTERM in 4 s: planner-3, …". A start or stop that takes less than half a second shows nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/user/steering.hpp"

namespace launch {

class StatusLine {
 public:
  static constexpr Duration kPatience = std::chrono::milliseconds(500);  // before the line is shown
  static constexpr Duration kRate = std::chrono::milliseconds(100);      // between two lines, at least
  static constexpr Duration kCountdown = std::chrono::seconds(1);        // between two lines that count down

  // `show` gets the line, or "" when there is nothing to say. The references must outlive this object.
  StatusLine(EventLoop& loop, ProcessSupervisor& supervisor, const Steering& steering,
             std::function<void(const std::string& line)> show);

  // Shows nothing until suspend(false).
  void suspend(bool suspended);

 private:
  enum class Phase { kStarting, kRunning, kStopping };

  void on_event(const ProcessEvent& event);
  void begin(Phase phase);
  void refresh();
  std::string starting() const;
  std::string stopping() const;

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  const Steering& steering_;
  std::function<void(const std::string& line)> show_;
  Phase phase_ = Phase::kStarting;
  Duration shown_{0};       // when the line was last changed, or when it may be shown first
  std::size_t to_end_ = 0;  // processes that were alive when the launch began to stop
  bool suspended_ = false;
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
