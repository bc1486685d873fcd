// SPDX-License-Identifier: Apache-2.0
// What an export writes of the children of <launch>.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actions/builtin_actions.hpp"
#include "launcher/deploy/deployment.hpp"

namespace test_support {

inline launch::Environment shell() {
  return {{"HOME", "/home/user"}, {"PATH", "/usr/bin:/bin"}};
}

// Throws LaunchError.
inline launch::LaunchPlan plan_of(const std::string& xml) {
  static const launch::Registry registry = launch::builtin_actions();
  launch::LaunchContext context(registry, shell(), "", [](auto...) {});
  const auto file =
      std::make_shared<launch::SourceFile>("/test/system.launch.xml", "<launch>\n" + xml + "\n</launch>\n");
  return launch::plan_launch(context, *launch::parse_launch_description(file, registry));
}

inline launch::DeploymentOptions robot_options() {
  return {.kind = "--systemd",
          .name = "robot",
          .machine = "",
          .directory = "/etc/robot",
          .install_directory = "",
          .working_directory = "/home/user",
          .image = "robot:1",
          .shell = shell(),
          .shells_elsewhere = {}};
}

// The files as one text, each behind its path, without the first line of each.
template <typename Export>
std::string exported(const Export& as_files, const std::string& xml,
                     const launch::DeploymentOptions& options = robot_options()) {
  const launch::LaunchPlan plan = plan_of(xml);
  std::string text;
  for (const launch::DeployedFile& file : as_files(plan, options).files) {
    text += "== " + file.path + "\n" + file.content.substr(file.content.find('\n') + 1);
  }
  return text;
}

template <typename Export>
std::vector<std::string> left_out(const Export& as_files, const std::string& xml) {
  std::vector<std::string> all;
  const launch::LaunchPlan plan = plan_of(xml);
  for (const launch::LeftOut& left : as_files(plan, robot_options()).left_out) {
    all.push_back(left.what);
  }
  return all;
}

}  // namespace test_support
