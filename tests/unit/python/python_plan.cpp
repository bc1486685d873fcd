// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/python/python_plan.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "actions/builtin_actions.hpp"
#include "launcher/python/interpreter/python_module.hpp"

namespace test_support {

namespace fs = std::filesystem;

const std::string& stand_in_prefix() {
  static const std::string made = [] {
    const fs::path prefix = fs::path(testing::TempDir()) / ("python_test_" + std::to_string(::getpid()));
    fs::create_directories(prefix / "share/ament_index/resource_index/packages");
    fs::create_directories(prefix / "share/demo_nodes");
    fs::create_directories(prefix / "lib/demo_nodes");
    std::ofstream(prefix / "share/ament_index/resource_index/packages/demo_nodes").put('\n');
    for (const char* const program : {"talker", "listener"}) {
      const fs::path path = prefix / "lib/demo_nodes" / program;
      std::ofstream(path) << "#!/bin/sh\n";
      fs::permissions(path, fs::perms::owner_all);
    }
    return prefix.string();
  }();
  // Removes the prefix when the program ends.
  static const struct Remove {
    ~Remove() { fs::remove_all(made); }
  } at_end;
  return made;
}

PythonPlan plan_python(const std::string& text, const PythonOptions& options) {
  launch::use_python_module(PYTHON_MODULE);
  static const launch::Registry registry = launch::builtin_actions();
  PythonPlan planned;
  launch::LaunchContext context(registry, options.environment, stand_in_prefix(),
                                [&](launch::LogLevel, std::string_view logger, std::string_view message) {
                                  planned.messages.push_back("[" + std::string(logger) + "] " + std::string(message));
                                });
  for (const auto& [name, value] : options.arguments) {
    context.scope().configurations.insert_or_assign(name, value);
  }
  try {
    const auto description = launch::parse_launch_description(std::make_shared<launch::SourceFile>(options.path, text),
                                                              registry, context.scope());
    planned.plan = launch::plan_launch(context, *description);
  } catch (const launch::LaunchError& error) {
    planned.error = error.what();
  }
  planned.environment = context.scope().environment;
  return planned;
}

PythonPlan plan_items(const std::string& items, const PythonOptions& options) {
  return plan_python(
      "import launch\nfrom launch import *\nfrom launch.actions import *\nfrom launch.conditions import *\n"
      "from launch.substitutions import *\nfrom launch_ros.actions import *\nfrom launch_ros.descriptions import *\n"
      "from launch_ros.substitutions import FindPackageShare\nimport os\n\n\n"
      "def generate_launch_description():\n    return LaunchDescription([\n" +
          items + "\n    ])\n",
      options);
}

}  // namespace test_support
