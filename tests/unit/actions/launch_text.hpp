// SPDX-License-Identifier: Apache-2.0
// Plans launch files that a test holds as text.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "launcher/visit/launch_plan.hpp"

namespace test_support {

struct Planned {
  launch::LaunchPlan plan;
  std::vector<std::string> messages;  // of `log` actions and warnings: "[launch.user] text"
  std::string error;                  // what() of the LaunchError that ended the visit or the loading; "" for none
};

struct PlanOptions {
  std::map<std::string, std::string> arguments;
  launch::Environment environment = {{"HOME", "/home/user"}, {"PATH", "/usr/bin:/bin"}};
};

// The text is the content of a file "/test/system.launch.xml" or, when it doesn't start with '<', ".yaml".
Planned plan_text(const std::string& text, const PlanOptions& options = {});
// The same for the children of <launch>.
Planned plan_actions(const std::string& xml, const PlanOptions& options = {});

// The error of visiting the children of <launch> as for a run, but without starting anything. "" for none.
std::string run_error(const std::string& xml);

}  // namespace test_support
