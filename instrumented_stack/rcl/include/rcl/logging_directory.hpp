// SPDX-License-Identifier: Apache-2.0
// The folder in which processes keep their log files.
#pragma once

#include <filesystem>

namespace rcl {

// ROS_LOG_DIR, else ROS_HOME/log, else ~/.ros/log. A leading ~ becomes the home directory; it is removed if HOME is not
// set.
std::filesystem::path logging_directory();

}  // namespace rcl
