// SPDX-License-Identifier: Apache-2.0
// Where processes keep their log files.
#pragma once

#include <filesystem>

namespace rcl {

// ROS_LOG_DIR, else ROS_HOME/log, else ~/.ros/log. A leading ~ is the home directory, of which nothing is left where
// HOME is not set.
std::filesystem::path logging_directory();

}  // namespace rcl
