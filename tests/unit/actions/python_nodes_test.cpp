// SPDX-License-Identifier: Apache-2.0
#include "launcher/traced/python_nodes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/sandbox.hpp"

namespace {

using launch::Environment;
using launch::ProcessSpec;

class PythonNodes : public testing::Test {
 protected:
  PythonNodes() {
    const std::filesystem::path folder = sandbox_.directory() / "lib/launch/python_nodes";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "_launch_rclpy_events.abi3.so").flush();
  }

  std::string warning(std::vector<std::string> argv) const {
    ProcessSpec spec;
    spec.name = "py";
    spec.argv = std::move(argv);
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    return launch::python_nodes_without_events({spec}, sandbox_.directory().string());
  }

  test_support::Sandbox sandbox_;
};

TEST_F(PythonNodes, TheUsersPathStaysAndTheFolderIsInItOnce) {
  Environment environment;
  launch::give_python_nodes_events("/p", environment);
  EXPECT_EQ(environment["PYTHONPATH"], "/p/lib/launch/python_nodes");
  environment["PYTHONPATH"] = "/own:/other";
  launch::give_python_nodes_events("/p", environment);
  launch::give_python_nodes_events("/p", environment);
  EXPECT_EQ(environment["PYTHONPATH"], "/p/lib/launch/python_nodes:/own:/other");
}

TEST_F(PythonNodes, OptionsThatShutTheModuleOutAreTold) {
  const std::string told = "python-nodes has no effect on these processes: py (its Python has the option ";
  EXPECT_EQ(warning({"python3", "-S", "a.py"}), told + "-S)");
  EXPECT_EQ(warning({"/usr/bin/python3.11", "-uI", "a.py"}), told + "-I)");
  EXPECT_EQ(warning({"python3", "-W", "error", "-E", "a.py"}), told + "-E)");
  EXPECT_EQ(warning({"python3", "-Werror", "a.py", "-S"}), "");
  EXPECT_EQ(warning({"python3", "-m", "module", "-I"}), "");
  EXPECT_EQ(warning({"python3"}), "");
  EXPECT_EQ(warning({"sort", "-S", "1"}), "");
  const std::filesystem::path script = sandbox_.directory() / "script";
  std::ofstream(script) << "#!/usr/bin/python3 -I\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  EXPECT_EQ(warning({script.string()}), told + "-I)");
}

TEST_F(PythonNodes, AnInstallationWithoutTheModuleIsTold) {
  EXPECT_EQ(launch::python_nodes_without_events({}, "/nowhere"),
            "python-nodes has no effect: this installation was built without python3-dev");
}

}  // namespace
