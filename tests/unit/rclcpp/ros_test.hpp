// SPDX-License-Identifier: Apache-2.0
// A test with an initialised rclcpp in a network of its own.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <initializer_list>
#include <rclcpp/rclcpp.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/sandbox.hpp"

// The sandbox is made first and destroyed last: participants and their threads live within it.
class RosTest : public ::testing::Test {
 protected:
  RosTest() { rclcpp::init(0, nullptr); }
  ~RosTest() override { rclcpp::shutdown(); }

  // Starts again with a command line: {"--ros-args", "-p", "speed:=1"}.
  static void init(std::initializer_list<const char*> arguments) {
    rclcpp::shutdown();
    std::vector<const char*> argv = {"test"};
    argv.insert(argv.end(), arguments);
    rclcpp::init(static_cast<int>(argv.size()), argv.data());
  }

  test_support::Sandbox sandbox_;
};

// The longest time that a step of these tests may take on a busy machine.
inline constexpr std::chrono::seconds kPatience{20};

// What the exception says that the action throws; "no error" if it throws none of this kind.
template <typename ErrorT = std::invalid_argument, typename ActionT>
std::string error_of(ActionT action) {
  try {
    action();
  } catch (const ErrorT& error) {
    return error.what();
  }
  return "no error";
}

// Executes callbacks until `condition` holds. The condition is checked after each callback. It is also checked every
// few milliseconds, because not everything that may change it wakes the executor (discovery does not).
template <typename ConditionT>
bool spin_until(rclcpp::Executor& executor, ConditionT condition, std::chrono::nanoseconds patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) {
      return false;
    }
    executor.spin_once(std::chrono::milliseconds(5));
  }
  return true;
}
