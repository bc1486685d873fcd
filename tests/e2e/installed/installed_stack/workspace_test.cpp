// SPDX-License-Identifier: Apache-2.0
// `launch build` on a workspace, the shell that sources its setup.bash, and a shell where another ROS 2 is sourced.
#include <gmock/gmock.h>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using testing::HasSubstr;
using testing::MatchesRegex;

constexpr std::chrono::seconds kBuildTimeout{900};  // a machine that compiles much else takes its time
constexpr const char* kReach = "/count 1 1.75 of 3 joints\n";

class Workspace : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* part : {"instrumented_stack", "programs/build"}) {
      const CommandResult result =
          run_command({CMAKE, "--install", (fs::path(PROJECT_BUILD) / part).string(), "--prefix", prefix_.string()});
      ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    }
    fs::create_directories(workspace_);
    fs::copy(WORKSPACE_SOURCES, workspace_ / "src", fs::copy_options::recursive);
  }

  CommandResult build(std::vector<std::string> arguments) {
    std::vector<std::string> argv = {(prefix_ / "lib/launch/launch-build").string(), "-C", workspace_.string()};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    return run_command(Command{argv,
                               {{"AMENT_PREFIX_PATH", ""},
                                {"CMAKE_PREFIX_PATH", ""},
                                {"CMAKE_CXX_COMPILER_LAUNCHER", COMPILER_LAUNCHER},
                                {"PYTHONDONTWRITEBYTECODE", "1"}},
                               workspace_},
                       kBuildTimeout);
  }

  // In a bash without this test's environment.
  CommandResult in_shell(const std::string& script) {
    return run_command(
        {"env", "-i", "PATH=/usr/bin:/bin", "HOME=" + sandbox_.directory().string(), "bash", "-c", script});
  }

  test_support::Sandbox sandbox_;
  const fs::path prefix_ = sandbox_.directory() / "prefix";
  const fs::path workspace_ = sandbox_.directory() / "workspace";
};

TEST_F(Workspace, IsBuiltTestedAndSourced) {
  const CommandResult built = build({"--test"});
  EXPECT_EQ(built.exit_code, 0) << built.out << built.err;
  // A test of pytest is left out where the Python that is found first has none.
  const bool has_pytest = run_command({"python3", "-c", "import pytest"}).exit_code == 0;
  const std::string passed = has_pytest ? "2 tests passed\n" : "1 test passed\n";
  EXPECT_THAT(built.out, MatchesRegex("\\[1/2\\] arm_messages [0-9.]+ s, " + passed +
                                      "\\[2/2\\] arm_reach [0-9.]+ s, no tests\n"
                                      "2 packages built in [0-9.]+ s, " +
                                      passed));
  // What packages ask for when their tests are built is there, and says once that it does nothing.
  const std::string configured = test_support::read_file(workspace_ / "build/arm_messages/launch_build_configure.log");
  EXPECT_THAT(configured, HasSubstr("arm_messages: linters are left out where their programs, such as "));
  EXPECT_EQ(configured.find("linters are left out"), configured.rfind("linters are left out")) << configured;
  EXPECT_THAT(test_support::read_file(workspace_ / "build/arm_messages/test_results/ctest.xml"),
              HasSubstr("returns_0"));

  // A workspace can be moved.
  const fs::path moved = sandbox_.directory() / "moved";
  fs::rename(workspace_, moved);
  const std::string install = (moved / "install").string();
  const CommandResult sourced = in_shell("source " + install + "/setup.bash && echo $AMENT_PREFIX_PATH && " + install +
                                         "/arm_reach/lib/arm_reach/reach");
  EXPECT_EQ(sourced.out, install + "/arm_reach:" + install + "/arm_messages:" + prefix_.string() + "\n" + kReach)
      << sourced.err;

  // Python finds the messages, whose library has another name than the package's own.
  const std::string program =
      "from arm_messages.msg import Count, Distance, Reach; Reach.__import_type_support__(); "
      "print(Distance(meters=2.0), Count.SLOT_TYPES, Reach.IS_EXTENDED__DEFAULT)";
  EXPECT_EQ(in_shell("source " + install + "/setup.bash && python3 -B -c '" + program + "'").out,
            "arm_messages.msg.Distance(meters=2.0) (BasicType('uint32'),) True\n");

  // The libraries of another ROS 2, with the same names and nothing in them.
  const fs::path other = sandbox_.directory() / "other_ros2/lib";
  fs::create_directories(other);
  for (const char* name :
       {"libtracetools.so", "librcutils.so", "librmw.so", "librcl.so", "librclcpp.so", "libstd_msgs.so",
        "librcl_interfaces.so", "libfastcdr.so.1", "libfastcdr.so.2", "libfastrtps.so.2.9", "libfastdds.so.3.1"}) {
    const CommandResult made = run_command({COMPILER, "-shared", "-x", "c++", "/dev/null", "-o",
                                            (other / name).string(), std::string("-Wl,-soname,") + name});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  const std::string foreign = "export LD_LIBRARY_PATH=" + other.string() + "; ";
  EXPECT_EQ(in_shell(foreign + install + "/arm_reach/lib/arm_reach/reach").out, kReach);
  EXPECT_EQ(in_shell(foreign + (prefix_ / "lib/tracetools/status").string()).out, "Tracing enabled\n");
  EXPECT_EQ(in_shell(foreign + "ldd " + (prefix_ / "lib/librclcpp.so").string() + " | grep -c " + other.string()).out,
            "0\n");
}

// Packages that use the stack as tf2, tf2_ros, tf2_eigen, message_filters, diagnostic_updater and bond do, and a server
// of the kind of Navigation 2's that uses them all. One has plugins and benchmarks as urdf has them. Their own tests
// run, too.
TEST_F(Workspace, MayHoldLibrariesOnRclcpp) {
  fs::remove_all(workspace_ / "src");
  fs::copy(LIBRARIES_SOURCES, workspace_ / "src", fs::copy_options::recursive);
  const CommandResult built = build({"--test", "--cmake-args", "-DCMAKE_BUILD_TYPE=None"});
  EXPECT_EQ(built.exit_code, 0) << built.out << built.err;
  EXPECT_THAT(built.out, MatchesRegex(".*\n9 packages built in [0-9.]+ s, [0-9]+ tests passed\n"));
  for (const auto& [package, test] :
       {std::pair{"track_frames_ros", "test_listener"}, std::pair{"track_bond", "test_bond"},
        std::pair{"track_navigator", "test_navigator"}, std::pair{"track_parsers", "test_parsers"},
        std::pair{"track_parsers", "test_domain"}, std::pair{"track_parsers", "test_of_gmock"},
        std::pair{"track_parsers", "test_own_library"}}) {
    EXPECT_THAT(test_support::read_file(workspace_ / "build" / package / "test_results/ctest.xml"),
                HasSubstr("testcase name=\"" + std::string(test) + "\""));
  }
}

TEST_F(Workspace, TellsTheErrorsOfAPackageAndWhatIsNotBuiltBecauseOfThem) {
  test_support::write_file(workspace_ / "src/arm_messages/msg/Reach.idl", "module arm_messages {\n  modul msg {\n");
  const CommandResult built = build({"--no-tests"});
  EXPECT_EQ(built.exit_code, 1) << built.err;
  const std::string path = (workspace_ / "src/arm_messages/msg/Reach.idl").string();
  EXPECT_THAT(built.out, HasSubstr("[1/2] arm_messages: it does not compile\n    " + path +
                                   ":2:3: error: expected 'module', 'struct', 'typedef' or 'const' and not 'modul'\n"
                                   "        modul msg {\n        ^\n"));
  EXPECT_THAT(built.out, HasSubstr("failed: arm_messages, not built: arm_reach\n"));
}

}  // namespace
