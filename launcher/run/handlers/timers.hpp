// SPDX-License-Identifier: Apache-2.0
// The timers of a launch: each returns its request when its period is over.
#pragma once

#include <functional>
#include <iterator>
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
  // Forgets those of the launch file itself.
  void clear_declared() {
    timers_.remove_if([](const Timer& timer) { return !timer.request.by_handler; });
  }
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

inline void Timers::start(TimerRequest request) {
  timers_.push_back({std::move(request), nullptr});
  const auto timer = std::prev(timers_.end());
  timer->source = loop_.after(timer->request.period, [this, timer] { on_due(timer); });
}

inline void Timers::shutdown() {
  timers_.remove_if([](const Timer& timer) { return timer.request.cancel_on_shutdown; });
}

inline void Timers::on_due(std::list<Timer>::iterator timer) {
  TimerRequest request = std::move(timer->request);
  timers_.erase(timer);
  fire_(std::move(request));
}

}  // namespace launch
