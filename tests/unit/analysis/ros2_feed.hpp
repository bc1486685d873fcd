// SPDX-License-Identifier: Apache-2.0
// Feeds Ros2Analysis with events that follow one another.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracing/model/analysis/ros2_analysis.hpp"

namespace tracing::testing {

// Feeds events of one thread at a time; each is 10 ns after the previous one.
class Feed {
 public:
  Feed& in(ProcessId process, std::int64_t vtid) {
    origin_.process = process;
    origin_.vtid = vtid;
    return *this;
  }
  // The next event is at this time.
  Feed& at(std::int64_t time_ns) {
    origin_.time_ns = time_ns - 10;
    return *this;
  }
  Feed& allocates(std::uint64_t bytes) {
    origin_.time_ns += 10;
    analysis_->on_allocation(origin_, bytes);
    return *this;
  }
  Feed& operator()(const ros2::AnyEvent& event) {
    origin_.time_ns += 10;
    analysis_->on_event(origin_, event);
    return *this;
  }
  Feed& end(ros2::ObjectEnd::Kind kind, ros2::Handle handle) {
    origin_.time_ns += 10;
    analysis_->on_end(origin_, {kind, handle});
    return *this;
  }
  Feed& has_qos(ros2::EndpointQosEvent::Kind kind, ros2::Handle handle, const ros2::EndpointQos& qos) {
    origin_.time_ns += 10;
    analysis_->on_endpoint_qos(origin_, {kind, handle}, qos);
    return *this;
  }
  Feed& executes(ros2::ExecutionEvent::Kind kind, ros2::Handle handle) {
    origin_.time_ns += 10;
    analysis_->on_execution(origin_, {kind, handle});
    return *this;
  }
  Feed& ends_process(ProcessId process) {
    origin_.time_ns += 10;
    analysis_->on_process_end(process, origin_.time_ns);
    return *this;
  }
  // To be called before the first event.
  void define(std::vector<ChainDefinition> chains) {
    analysis_ = std::make_unique<Ros2Analysis>(nullptr, std::move(chains));
  }
  Ros2Results results() { return analysis_->finish(); }

 private:
  Origin origin_{0, 71, 71};
  std::unique_ptr<Ros2Analysis> analysis_ = std::make_unique<Ros2Analysis>();
};

inline const TopicResult& topic(const Ros2Results& results, std::string_view name) {
  for (const TopicResult& result : results.topics) {
    if (result.name == name) {
      return result;
    }
  }
  throw std::runtime_error("no topic " + std::string(name));
}

}  // namespace tracing::testing
