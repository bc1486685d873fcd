// SPDX-License-Identifier: Apache-2.0
// The common part of the main functions of all containers.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "rclcpp/rclcpp.hpp"

namespace rclcpp_components {

// Calls `run` with the arguments that are not for ROS, starting with the program's name. Prints an exception, also of a
// component, as one line on stderr. Returns the exit code of the program.
template <typename RunT>
int container_main(const char* program, int argc, char** argv, RunT run) {
  try {
    run(rclcpp::init_and_remove_ros_arguments(argc, argv));
    rclcpp::shutdown();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace rclcpp_components
