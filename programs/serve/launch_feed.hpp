// SPDX-License-Identifier: Apache-2.0
// What happens in a launch, as server-sent events: https://html.spec.whatwg.org/multipage/server-sent-events.html
//
//   event: ps       the answer to "ps" with `cpu`, `memory` and `lines` of each process, and `time`: each second
//   event: event    an event of the control protocol (docs/control.md)
//   event: output   a line of the process that was asked for; `past` is true if it stands in launch.log
//   event: end      the launch has ended: the last one
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "launcher/control/control_client.hpp"

namespace launch::serve {

// For use by one thread.
class LaunchFeed {
 public:
  static constexpr std::chrono::milliseconds kPeriod{1000};
  static constexpr std::size_t kPastLines = 300;

  // `process` is the name of the process whose lines are wanted, or "". `stop` becomes readable when the feed is to
  // end. Throws ControlError.
  LaunchFeed(ControlClient launch, std::string process, int stop);

  // Waits for the next events, a second at most. Nothing: the feed has ended.
  std::optional<std::string> next();

 private:
  void add_ps();
  void add_event(const ControlClient::Json& event);
  void add_past_lines(const std::string& log, std::size_t size);
  void add(const char* name, const ControlClient::Json& data);

  ControlClient launch_;
  std::string process_;
  int stop_;
  std::string text_;  // that next() will give
  std::map<std::string, std::uint64_t> lines_;
  std::chrono::steady_clock::time_point next_ps_;
  bool ended_ = false;
};

}  // namespace launch::serve
