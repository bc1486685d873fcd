// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/timers.hpp"

#include <iterator>

namespace launch {

void Timers::start(TimerRequest request) {
  timers_.push_back({std::move(request), nullptr});
  const auto timer = std::prev(timers_.end());
  timer->source = loop_.after(timer->request.period, [this, timer] { on_due(timer); });
}

void Timers::shutdown() {
  timers_.remove_if([](const Timer& timer) { return timer.request.cancel_on_shutdown; });
}

void Timers::on_due(std::list<Timer>::iterator timer) {
  TimerRequest request = std::move(timer->request);
  timers_.erase(timer);
  fire_(std::move(request));
}

}  // namespace launch
