// SPDX-License-Identifier: Apache-2.0
// Plans Python launch files that a test holds as text.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "launcher/visit/launch_plan.hpp"

namespace test_support {

// An install prefix with a package "demo_nodes", whose programs talker and listener do nothing.
const std::string& stand_in_prefix();

struct PythonPlan {
  launch::LaunchPlan plan;
  std::vector<std::string> messages;  // "[logger] text"
  std::string error;                  // what() of the LaunchError that ended the visit or the loading; "" for none
  launch::Environment environment;    // at the end
};

struct PythonOptions {
  std::map<std::string, std::string> arguments;
  launch::Environment environment = {{"HOME", "/home/user"}, {"PATH", "/usr/bin:/bin"}};
  std::string path = "/test/system.launch.py";
};

// `text` is the content of a file of that path.
PythonPlan plan_python(const std::string& text, const PythonOptions& options = {});

// The same for the items of the list that generate_launch_description() returns. Every name of launch and launch_ros is
// imported.
PythonPlan plan_items(const std::string& items, const PythonOptions& options = {});

}  // namespace test_support
