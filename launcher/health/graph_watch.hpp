// SPDX-License-Identifier: Apache-2.0
// A request to launch-ros-client that a probe keeps up while its process runs. There is one such program for all
// watches of a launch. If it ends, the probe asks again, which starts another one.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "launcher/process/event_loop.hpp"
#include "launcher/ros/ros_client.hpp"

namespace launch {

class GraphWatch {
 public:
  // The least time between two requests, of which the first has failed.
  static constexpr Duration kPatience = std::chrono::seconds(5);

  // The client may be null: then nothing is known. Otherwise it must outlive this object. `environment` chooses the
  // graph.
  GraphWatch(RosClient* client, RosRequest request, Environment environment)
      : client_(client), request_(std::move(request)), environment_(std::move(environment)) {}

  void begin(std::function<void(const RosAnswer&)> on_answer) {
    on_answer_ = std::move(on_answer);
    asked_.reset();
    lost_.clear();
  }
  void end() { answers_.reset(); }

  // Asks if there is no request under way. Returns why nothing is known; empty: there is a request.
  const std::string& keep_up(Duration now) {
    if (client_ == nullptr) {
      lost_ = "there is no ROS client";
    } else if (!answers_ && (!asked_ || now - *asked_ >= kPatience)) {
      asked_ = now;
      lost_.clear();
      answers_ = client_->ask(request_, environment_, Duration{0}, [this](const RosAnswer& answer) {
        if (answer.ok) {
          on_answer_(answer);
        } else {
          lost_ = answer.error;
          answers_.reset();
        }
      });
    }
    return lost_;
  }

 private:
  RosClient* client_;
  RosRequest request_;
  Environment environment_;
  std::function<void(const RosAnswer&)> on_answer_;
  std::optional<Duration> asked_;
  std::string lost_;
  EventLoop::SourcePtr answers_;
};

}  // namespace launch
