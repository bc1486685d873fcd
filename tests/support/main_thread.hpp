// SPDX-License-Identifier: Apache-2.0
// The events of the main thread of a process, one after another, for tests of the order in which layers are traced.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "launch_trace_testing/expectations.hpp"

namespace test_support {

using Events = std::vector<const launch_trace_testing::Event*>;

// Events of ROS 2 of this name, such as "rcl_publish", in the main thread of the process.
inline launch_trace_testing::EventQuery of_main_thread(const std::string& process, const std::string& name) {
  return launch_trace_testing::event("ros2:" + name)
      .in_process(process)
      .that("in its main thread",
            [](const launch_trace_testing::Event& event) { return event.vpid() == event.vtid(); });
}

// The one event that is meant. Without it, the test ends with the nearest ones. It is no reference, because GCC from 13
// on would take it for a part of the query, which the call has made.
inline const launch_trace_testing::Event* only(const launch_trace_testing::Trace& trace,
                                               const launch_trace_testing::EventQuery& query) {
  using namespace launch_trace_testing;
  if (const Verdict verdict = expect_count(trace, query, exactly(1)); !verdict) {
    throw std::runtime_error(verdict.text);
  }
  return query.first(trace);
}

// The names, without their provider.
inline std::vector<std::string> names(const Events& events) {
  std::vector<std::string> result;
  for (const launch_trace_testing::Event* const event : events) {
    result.push_back(event->name().substr(event->name().find(':') + 1));
  }
  return result;
}

// Part of `thread`: from `before` events before `middle`, which is one of it, to `after` events behind it, or as far as
// there are some.
inline Events around(const Events& thread, const launch_trace_testing::Event& middle, std::ptrdiff_t before,
                     std::ptrdiff_t after) {
  const auto at = std::find(thread.begin(), thread.end(), &middle);
  if (at == thread.end()) {
    throw std::invalid_argument("the event is not of this thread: " + to_string(middle));
  }
  return {at - std::min(before, at - thread.begin()), at + 1 + std::min(after, thread.end() - at - 1)};
}

}  // namespace test_support
