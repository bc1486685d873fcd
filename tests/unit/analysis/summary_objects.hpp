// SPDX-License-Identifier: Apache-2.0
// A few objects for tests of the functions that make results.
#pragma once

#include <gtest/gtest.h>

#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing::testing {

// Process 1, which lost events, is at place 0. It has node /node with publisher 0 and subscription 0 of /topic
// (callback 0) and timer 0 of 100 ns (callback 1).
class SummaryObjects : public ::testing::Test {
 protected:
  SummaryObjects() {
    const Origin begin{0, 1, 1};
    model.on(begin, ros2::RclNodeInit{7, 8, "node", "/"});
    model.on(begin, ros2::RmwPublisherInit{1, {}});
    model.on(begin, ros2::RclPublisherInit{11, 7, 1, "/topic", 1});
    model.on(begin, ros2::RmwSubscriptionInit{2, {}});
    model.on(begin, ros2::RclSubscriptionInit{12, 7, 2, "/topic", 5});
    model.on(begin, ros2::RclcppSubscriptionInit{12, 22});
    model.on(begin, ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
    model.on(begin, ros2::RclTimerInit{3, 100});
    model.on(begin, ros2::RclcppTimerCallbackAdded{3, 0xee});
    model.on(begin, ros2::RclcppTimerLinkNode{3, 7});
    processes[0].doubtful = true;
  }

  ObjectModel model;
  std::vector<ProcessResult> processes{1};
  const Subjects subjects{model, {std::nullopt, 0}, processes};
  ExecutionSink nobody;
};

}  // namespace tracing::testing
