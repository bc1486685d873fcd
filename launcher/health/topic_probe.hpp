// SPDX-License-Identifier: Apache-2.0
// Whether messages are published on a topic as often as they should be.
//
// What counts is a window: the last looks, which are as long as the time-out together. The time in which the process
// waits for a processor is left out of it, and so is the time in which launch-ros-client got none.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "launcher/health/graph_watch.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"

namespace launch {

class TopicProbe final : public HealthProbe {
 public:
  TopicProbe(GraphWatch graph, TopicIsPublished topic, Duration timeout, ProcessorWait wait = ProcessorWait())
      : graph_(std::move(graph)), topic_(std::move(topic)), timeout_(timeout), wait_(std::move(wait)) {}

  void begin(pid_t pid) override;
  void end() override { graph_.end(); }
  Look look(Duration now, Duration passed) override;

 private:
  struct Part {
    Duration time{0};
    std::uint64_t messages = 0;
  };

  Look judge() const;

  GraphWatch graph_;
  TopicIsPublished topic_;
  Duration timeout_;
  ProcessorWait wait_;
  pid_t pid_ = -1;
  TopicTraffic news_;  // since the last look
  std::deque<Part> window_;
  Part sum_;  // of the window
};

}  // namespace launch
