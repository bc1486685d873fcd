// SPDX-License-Identifier: Apache-2.0
// Feeds Ros2Analysis with events that follow one another.
#pragma once

#include <stdexcept>
#include <string>

#include "tracing/analysis/ros2_analysis.hpp"

namespace tracing::testing {

// Feeds events of one thread at a time; each is 10 ns after the previous one.
class Feed {
 public:
  Feed& in(Vpid vpid, std::int64_t vtid) {
    origin_.vpid = vpid;
    origin_.vtid = vtid;
    return *this;
  }
  Feed& operator()(const ros2::AnyEvent& event) {
    origin_.time_ns += 10;
    analysis_.on_event(origin_, event);
    return *this;
  }
  Feed& end(ros2::ObjectEnd::Kind kind, ros2::Handle handle) {
    origin_.time_ns += 10;
    analysis_.on_end(origin_, {kind, handle});
    return *this;
  }
  Feed& executes(ros2::ExecutionEvent::Kind kind, ros2::Handle handle) {
    origin_.time_ns += 10;
    analysis_.on_execution(origin_, {kind, handle});
    return *this;
  }
  Ros2Results results() { return analysis_.finish(); }

 private:
  Origin origin_{0, 71, 71};
  Ros2Analysis analysis_;
};

inline const TopicResult& topic(const Ros2Results& results, const std::string& name) {
  for (const TopicResult& result : results.topics) {
    if (result.name == name) return result;
  }
  throw std::runtime_error("no topic " + name);
}

}  // namespace tracing::testing
