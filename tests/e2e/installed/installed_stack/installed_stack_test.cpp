// SPDX-License-Identifier: Apache-2.0
// The stack as its users have it: installed, moved, and found by a project of their own.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::HasSubstr;

constexpr std::chrono::seconds kBuildTimeout{900};

CommandResult run(std::vector<std::string> argv) {
  const CommandResult result = run_command(Command{std::move(argv)}, kBuildTimeout);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  return result;
}

class InstalledStack : public testing::Test {
 protected:
  void SetUp() override {
    run({CMAKE, "--install", STACK_BUILD, "--prefix", (sandbox_.directory() / "first").string()});
    fs::rename(sandbox_.directory() / "first", prefix_);
  }

  test_support::Sandbox sandbox_;
  const fs::path prefix_ = sandbox_.directory() / "moved";
};

TEST_F(InstalledStack, ServesAProjectWithItsOwnMessagesAndComponents) {
  const fs::path build = sandbox_.directory() / "build";
  run({CMAKE, "-S", OUTSIDE_PROJECT, "-B", build.string(), "-G", GENERATOR, "-DCMAKE_PREFIX_PATH=" + prefix_.string(),
       "-DCMAKE_CXX_COMPILER=" COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" COMPILER_LAUNCHER});
  run({CMAKE, "--build", build.string()});
  const CommandResult result = run({(build / "station").string()});
  EXPECT_EQ(result.out,
            "weather/srv/Forecast_Event\n"
            "{header: {stamp: {sec: 0, nanosec: 0}, frame_id: \"\"}, temperature: 20.5, sky: \"clear\"}\ntracing on\n");

  // The package that the project installs has the same shape.
  const fs::path other = sandbox_.directory() / "other";
  run({CMAKE, "--install", build.string(), "--prefix", other.string()});
  for (const char* file :
       {"lib/libweather.so", "include/weather/weather/msg/report.hpp", "share/weather/msg/Report.msg",
        "share/weather/cmake/weatherConfig.cmake", "share/ament_index/resource_index/packages/weather"}) {
    EXPECT_TRUE(fs::exists(other / file)) << file;
  }

  // Its components have the same shape, too: a program, and libraries that a container of the stack finds by the index.
  EXPECT_EQ(test_support::read_file(other / "share/ament_index/resource_index/rclcpp_components/weather"),
            "instruments::Barometer;lib/libinstruments.so\ninstruments::Thermometer;lib/libinstruments.so\n");
  EXPECT_EQ(run({(other / "lib/weather/barometer").string(), "--ros-args", "-r", "__ns:=/roof"}).out,
            "/roof/barometer: 1013 hPa\n");
  RunningCommand container(Command{{(prefix_ / "lib/rclcpp_components/component_container").string()},
                                   {{"AMENT_PREFIX_PATH", other.string()}}});
  EXPECT_EQ(run({(build / "observer").string()}).out,
            "loaded /thermometer\n"
            "{header: {stamp: {sec: 0, nanosec: 0}, frame_id: \"\"}, temperature: -3.5, sky: \"clear\"}\n");
  container.send_signal(SIGINT);
  const CommandResult contained = container.wait();
  EXPECT_EQ(contained.exit_code, 0) << contained.err;
}

// Configures, builds and installs one of AMENT_PACKAGES as colcon does.
void build_ament_package(const std::string& package, const fs::path& build, const fs::path& install,
                         const std::string& prefix_path) {
  run({CMAKE, "-S", AMENT_PACKAGES "/" + package, "-B", build.string(), "-G", GENERATOR,
       "-DCMAKE_PREFIX_PATH=" + prefix_path, "-DCMAKE_INSTALL_PREFIX=" + install.string(),
       "-DCMAKE_CXX_COMPILER=" COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" COMPILER_LAUNCHER});
  run({CMAKE, "--build", build.string()});
  run({CMAKE, "--install", build.string()});
}

TEST_F(InstalledStack, BuildsAmentPackagesUnchanged) {
  const fs::path driver = sandbox_.directory() / "driver";
  const fs::path monitor = sandbox_.directory() / "monitor";
  build_ament_package("arm_driver", sandbox_.directory() / "build_driver", driver, prefix_.string());
  EXPECT_EQ(run({(driver / "lib/arm_driver/arm_node").string(), "--ros-args", "-r", "__ns:=/left"}).out,
            "/left/arm\n{header: {stamp: {sec: 0, nanosec: 0}, frame_id: \"shoulder\"}, torques: [3.0, 1.5]}\n");
  EXPECT_EQ(test_support::read_file(driver / "share/ament_index/resource_index/rclcpp_components/arm_driver"),
            "arm_driver::ArmComponent;lib/libarm_component.so\narm_driver::SelfTest;lib/libarm_component.so\n");
  EXPECT_EQ(run({(driver / "lib/arm_driver/self_test").string()}).out, "the arm is there\n");
  EXPECT_EQ(run({(driver / "lib/arm_driver/effort_in_c").string()}).out, "elbow: 44 bytes\n");
  const fs::path settings = sandbox_.directory() / "settings.yaml";
  std::ofstream(settings) << "/arm:\n  elbow:\n    ros__parameters: {speed: 1.5, limits: {angles: [10, 90]}}\n";
  EXPECT_EQ(run({(driver / "lib/arm_driver/settings_in_c").string(), settings.string()}).out,
            "speed 1.5\n\n Node Name\t\t\t\tParameters\n/arm/elbow\n"
            "                                             speed: 1.500000\n"
            "                                     limits.angles: 10, 90, \n");
  // Programs in C++ do not load what is there for C.
  const std::string libraries = run({"ldd", (driver / "lib/arm_driver/arm_node").string()}).out;
  EXPECT_NE(libraries.find("libstd_msgs.so"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("rosidl_typesupport_c"), std::string::npos) << libraries;
  for (const char* file : {"share/ament_index/resource_index/packages/arm_driver", "share/arm_driver/package.xml",
                           "share/arm_driver/msg/Effort.msg", "include/arm_driver/arm_driver/arm_model.hpp",
                           "include/arm_driver/arm_driver/version.h"}) {
    EXPECT_TRUE(fs::exists(driver / file)) << file;
  }
  const CommandResult tests =
      run({CTEST, "--test-dir", (sandbox_.directory() / "build_driver").string(), "--output-on-failure"});
  EXPECT_NE(tests.out.find("100% tests passed, 0 tests failed out of 1"), std::string::npos) << tests.out;

  build_ament_package("arm_monitor", sandbox_.directory() / "build_monitor", monitor,
                      prefix_.string() + ";" + driver.string());
  EXPECT_EQ(run({(monitor / "lib/arm_monitor/monitor").string()}).out, "5\n");
  EXPECT_TRUE(fs::exists(monitor / "share/arm_monitor/launch/monitor.launch.xml"));
}

// Most packages depend on most others in many ways.
TEST_F(InstalledStack, ReadsTheConfigurationOfAPackageOnceInAScope) {
  const fs::path project = sandbox_.directory() / "project";
  test_support::write_file(project / "CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.16)
project(finder)
function(find_in_a_function)
  find_package(rclcpp_lifecycle REQUIRED)
endfunction()
find_in_a_function()
message(STATUS "outside: '${builtin_interfaces_TARGETS}'")
find_package(rclcpp_action REQUIRED)
find_package(rclcpp REQUIRED)
message(STATUS "found: '${builtin_interfaces_TARGETS}'")
add_subdirectory(part)
)");
  test_support::write_file(project / "part/CMakeLists.txt", R"(
find_package(builtin_interfaces REQUIRED)
message(STATUS "in the folder: '${builtin_interfaces_TARGETS}', ${builtin_interfaces_FOUND}")
)");
  const CommandResult configured =
      run({CMAKE, "-S", project.string(), "-B", (sandbox_.directory() / "build").string(), "-G", GENERATOR,
           "-DCMAKE_PREFIX_PATH=" + prefix_.string(), "-DCMAKE_CXX_COMPILER=" COMPILER,
           "--trace-source=builtin_interfacesTargets.cmake"});
  const std::string targets =
      "builtin_interfaces::builtin_interfaces;"
      "builtin_interfaces::builtin_interfaces__rosidl_generator_c";
  EXPECT_THAT(configured.out,
              HasSubstr("-- outside: ''\n-- found: '" + targets + "'\n-- in the folder: '" + targets + "', 1\n"));
  // One line of the file, once for the function and once for the rest.
  const std::string line = "cmake_policy(PUSH )";
  int reads = 0;
  for (auto at = configured.err.find(line); at != std::string::npos; at = configured.err.find(line, at + 1)) {
    ++reads;
  }
  EXPECT_EQ(reads, 2) << configured.err;
}

TEST_F(InstalledStack, FindsItsLibrariesWhereItWasMovedTo) {
  EXPECT_EQ(run({(prefix_ / "lib/tracetools/status").string()}).out, "Tracing enabled\n");
  const std::string libraries = run({"ldd", (prefix_ / "lib/tracetools/status").string()}).out;
  EXPECT_NE(libraries.find(prefix_.string()), std::string::npos) << libraries;
}

// ldd lists libraries in the order in which the dynamic linker searches them.
TEST_F(InstalledStack, SearchesFastDdsBeforeItsOwnLibraries) {
  const std::string libraries = run({"ldd", (prefix_ / "lib/librclcpp.so").string()}).out;
  const std::size_t fast_dds = std::min(libraries.find("libfastrtps.so"), libraries.find("libfastdds.so"));
  ASSERT_NE(fast_dds, std::string::npos) << libraries;
  EXPECT_LT(fast_dds, libraries.find("librcl.so")) << libraries;
  EXPECT_LT(fast_dds, libraries.find("libtype_description_interfaces.so")) << libraries;
}

TEST_F(InstalledStack, HoldsNoPathOfTheBuild) {
  const std::string build_root = fs::path(STACK_BUILD).parent_path().string();
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(prefix_)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".cmake" && extension != ".hpp" && extension != ".h" && extension != ".xml") {
      continue;
    }
    ++files;
    EXPECT_EQ(test_support::read_file(entry.path()).find(build_root), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 100);
}

}  // namespace
