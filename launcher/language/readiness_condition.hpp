// SPDX-License-Identifier: Apache-2.0
// Something outside that a process may have to wait for before it starts, such as a service that is offered.
//
// `depends_on` (launcher/run/start_order.hpp) watches it from the moment at which the waiting process was asked for.
// What other processes of the launch do is no such condition: the launch itself knows it
// (launcher/visit/dependency.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "launcher/process/event_loop.hpp"

namespace launch {

class ReadinessCondition {
 public:
  // Nothing when the condition holds; else why it can't be known any more: "the ROS client has ended".
  using Done = std::function<void(const std::optional<std::string>& failure)>;

  // Ends the watch: `done` is not called any more.
  virtual ~ReadinessCondition() = default;

  // Begins to watch. Called once, on the loop's thread; must not block. `done` is called at most once, on the loop's
  // thread, later than this call. Time-outs are the caller's.
  virtual void watch(EventLoop& loop, Done done) = 0;

  // A sentence for messages and --dry-run: "service /map/load is offered".
  virtual std::string describe() const = 0;
};

}  // namespace launch
