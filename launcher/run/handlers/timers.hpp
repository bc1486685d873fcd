// SPDX-License-Identifier: Apache-2.0
// The timers of a launch: each returns its request when its period is over.
#pragma once

#include <functional>
#include <list>
#include <utility>

#include "launcher/process/event_loop.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Timers {
 public:
  // `fire` is called in a turn of the loop of its own. The loop must outlive this object.
  Timers(EventLoop& loop, std::function<void(TimerRequest)> fire) : loop_(loop), fire_(std::move(fire)) {}

  void start(TimerRequest request);
  // Forgets the timers that a shutdown cancels. The others still fire.
  void shutdown();
  // Forgets all timers.
  void clear() { timers_.clear(); }
  bool empty() const { return timers_.empty(); }

 private:
  struct Timer {
    TimerRequest request;
    EventLoop::SourcePtr source;
  };

  void on_due(std::list<Timer>::iterator timer);

  EventLoop& loop_;
  std::function<void(TimerRequest)> fire_;
  std::list<Timer> timers_;
};

}  // namespace launch
