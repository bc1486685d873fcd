// SPDX-License-Identifier: Apache-2.0
// The work of launch-ros-client: takes requests, continues all open requests whenever something changes, and answers
// them.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

#include "launcher/ros/ros_protocol.hpp"
#include "programs/ros_client/operation.hpp"

namespace launch {

class RequestLoop {
 public:
  using Send = std::function<void(const RosAnswerLine&)>;

  // Answers are given to `send` on the thread of run().
  RequestLoop(rclcpp::Node& node, Send send);

  // May be called from any thread.
  void post(RosRequestLine line);
  void quit();

  // Runs until quit(), on one thread.
  void run();

 private:
  using Clock = std::chrono::steady_clock;
  struct UnderWay {
    std::unique_ptr<Operation> operation;
    std::optional<Clock::time_point> deadline;
    Duration timeout{0};
  };

  // False after quit().
  bool take_posted();
  void start(const RosRequestLine& line);
  void look();
  void wait();

  rclcpp::Node& node_;
  Send send_;
  rclcpp::GuardCondition wake_;
  std::map<RosRequestId, UnderWay> under_way_;

  std::mutex mutex_;  // guards the members below
  std::vector<RosRequestLine> posted_;
  bool quit_ = false;
};

}  // namespace launch
