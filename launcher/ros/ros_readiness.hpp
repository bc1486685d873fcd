// SPDX-License-Identifier: Apache-2.0
// Conditions of the ROS graph that a process may have to wait for before it starts.
#pragma once

#include "launcher/language/readiness_condition.hpp"
#include "launcher/ros/ros_client.hpp"

namespace launch {

class RosReadiness final : public ReadinessCondition {
 public:
  // `condition` is one of the requests that are conditions (ros_client.hpp). The client may be null when nothing is
  // watched, as in a dry run; otherwise it must outlive this object. `environment` chooses the graph.
  RosReadiness(RosClient* client, RosRequest condition, Environment environment)
      : client_(client), condition_(std::move(condition)), environment_(std::move(environment)) {}

  void watch(EventLoop& loop, Done done) override;
  // "service '/map/load' is offered", "a message has come on '/scan'".
  std::string describe() const override;
  // "inactive", "parameter 'rate' is 10"
  std::string seen() const override { return seen_; }

 private:
  RosClient* client_;
  RosRequest condition_;
  Environment environment_;
  std::string seen_;
  EventLoop::SourcePtr watch_;
};

}  // namespace launch
