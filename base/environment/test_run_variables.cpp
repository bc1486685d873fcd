// SPDX-License-Identifier: Apache-2.0
#include "base/environment/test_run_variables.hpp"

#include "base/environment/home_directory.hpp"

namespace launch {

Environment with_variables_of_a_test_run(Environment environment) {
  environment.emplace("ROS_HOME", ros_home(environment));
  environment.emplace("ROS_LOG_DIR", ros_log_directory(environment));
  environment.emplace("ROS_TRACE_DIR", environment.at("ROS_HOME") + "/tracing");
  environment.emplace("ROS_DOMAIN_ID", "0");
  environment.emplace("LAUNCH_TEST_SEED", "1");
  return environment;
}

}  // namespace launch
