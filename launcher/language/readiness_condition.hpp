// SPDX-License-Identifier: Apache-2.0
// Something outside that a process may have to wait for before it starts, such as a service that is offered.
//
// `depends_on` (launcher/run/start/start_order.hpp) watches it from the moment at which the waiting process was asked
// for. A condition on another process of the launch is not of this kind: the launch itself knows about it
// (launcher/visit/dependency.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "launcher/process/event_loop.hpp"

namespace launch {

class ReadinessCondition {
 public:
  // The argument is nullopt when the condition holds. Otherwise it is the reason why the condition can't be known any
  // more: "the ROS client has ended".
  using Done = std::function<void(const std::optional<std::string>& failure)>;

  // Ends the watch: `done` is not called after this.
  virtual ~ReadinessCondition() = default;

  // Begins to watch. Called once, on the loop's thread; must not block. `done` is called at most once, on the loop's
  // thread, later than this call. The caller handles time-outs.
  virtual void watch(EventLoop& loop, Done done) = 0;

  // A sentence for messages and --dry-run: "service /map/load is offered".
  virtual std::string describe() const = 0;

  // What is there instead, as far as it is known: "inactive".
  virtual std::string seen() const { return {}; }
};

}  // namespace launch
