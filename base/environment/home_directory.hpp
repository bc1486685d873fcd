// SPDX-License-Identifier: Apache-2.0
// The home directory of the user, and what ROS 2 keeps in it.
//
// Each function takes an environment, because the environment of a launch differs from the launcher's own when
// <set_env> has changed it. A variable that is set to "" counts as not set, as in rcutils. Several threads may call
// these functions at once.
#pragma once

#include <map>
#include <string>

namespace launch {

// $HOME of `environment`, else the directory that the password database has for the user of this process, else "/".
// Never "" and never a directory that everybody can write to, such as /tmp.
std::string home_directory(const std::map<std::string, std::string>& environment);
// The same with the environment of this process.
std::string home_directory();

// `path` with its first "~" replaced when it is "~" or begins with "~/". "~name" stays: rcutils does not know other
// users either.
std::string expand_home(const std::string& path, const std::map<std::string, std::string>& environment);

// Where ROS 2 keeps logs and traces: $ROS_HOME, else ~/.ros, with "~" replaced.
std::string ros_home(const std::map<std::string, std::string>& environment);

// Where nodes write their logs, by rcl_logging's rule: $ROS_LOG_DIR, else "log" in ros_home(), with "~" replaced.
std::string ros_log_directory(const std::map<std::string, std::string>& environment);

}  // namespace launch
