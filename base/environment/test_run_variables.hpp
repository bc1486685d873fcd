// SPDX-License-Identifier: Apache-2.0
// The variables that `launch test` sets in each run of a test, with values of its own.
#pragma once

#include "base/environment/environment.hpp"
#include "base/environment/home_directory.hpp"

namespace launch {

// What the names of LTTng sessions end with in the launches of a test, so that tests with the same launch file run side
// by side. Launches within launches inherit it.
inline constexpr const char* kSessionSuffixVariable = "LAUNCH_SESSION_SUFFIX";

// For a look at a test that does not run: `environment` with a value for each variable that it does not have.
Environment with_variables_of_a_test_run(Environment environment);

inline Environment with_variables_of_a_test_run(Environment environment) {
  environment.emplace("ROS_HOME", ros_home(environment));
  environment.emplace("ROS_LOG_DIR", ros_log_directory(environment));
  environment.emplace("ROS_TRACE_DIR", environment.at("ROS_HOME") + "/tracing");
  environment.emplace("ROS_DOMAIN_ID", "0");
  environment.emplace("LAUNCH_TEST_SEED", "1");
  return environment;
}

}  // namespace launch
