// SPDX-License-Identifier: Apache-2.0
// A unit of systemd that runs a launch (systemd.service(5)).
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

struct UnitFile {
  std::string description;
  std::vector<std::string> command;  // the first word is an absolute path
  std::string directory;
  std::string user;  // "": that of the service manager
  std::vector<std::pair<std::string, std::string>> variables;
  std::chrono::seconds stop_timeout{90};
  bool realtime = false;
  bool hardened = false;
  bool of_user = false;  // for the service manager of a user
};

// The first line of each unit that unit_text() makes.
inline constexpr const char* kUnitMark = "# Made by 'launch unit install'. 'launch unit remove' takes it away.";

std::string unit_text(const UnitFile& unit);

// What a launch needs of the environment of a shell in which the set-up files have been sourced: the variables of ROS
// 2, of its middlewares and of LTTng, paths of programs, libraries and Python modules, and those of the names `also`.
std::vector<std::pair<std::string, std::string>> variables_for_unit(const Environment& environment,
                                                                    const std::vector<std::string>& also);

// "launch-system" for /opt/robot/system.launch.xml: characters that a unit can't have become "-".
std::string unit_name_of(const std::string& launch_file);

}  // namespace launch
