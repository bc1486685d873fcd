// SPDX-License-Identifier: Apache-2.0
// The expectations on traces as their users have them: installed, moved, and found by the project of the example.
#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::HasSubstr;
using testing::Not;

constexpr std::chrono::seconds kPatience{300};
const std::string kExample = EXAMPLES_DIRECTORY "/ping_pong_test";

class InstalledTesting : public testing::Test {
 protected:
  InstalledTesting() : prefix_(sandbox_.directory() / "moved") {
    run({{CMAKE, "--install", TESTING_BUILD, "--prefix", (sandbox_.directory() / "first").string()}});
    fs::rename(sandbox_.directory() / "first", prefix_);
  }

  static CommandResult run(const Command& command, int exit_code = 0) {
    const CommandResult result = run_command(command, kPatience);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    return result;
  }

  Sandbox sandbox_;
  fs::path prefix_;
};

TEST_F(InstalledTesting, HasNoPathOfTheBuildAndNoPrivateHeader) {
  const std::string build_root = fs::path(TESTING_BUILD).parent_path().parent_path().string();
  int headers = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(prefix_)) {
    if (!entry.is_regular_file() || entry.path().string().find(".so") != std::string::npos) {
      continue;
    }
    const std::string text = read_file(entry.path());
    EXPECT_THAT(text, Not(HasSubstr(build_root))) << entry.path();
    if (entry.path().extension() == ".hpp") {
      ++headers;
      EXPECT_THAT(text, Not(HasSubstr("#include \"tracing/"))) << entry.path();
      EXPECT_THAT(text, Not(HasSubstr("#include \"launcher/"))) << entry.path();
    }
  }
  EXPECT_EQ(headers, 7);
}

TEST_F(InstalledTesting, ServesTheProjectOfTheExample) {
  const std::string build = (sandbox_.directory() / "build").string();
  run({{CMAKE, "-S", kExample, "-B", build, "-G", GENERATOR, "-DCMAKE_PREFIX_PATH=" + prefix_.string(),
        "-DCMAKE_CXX_COMPILER=" COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" COMPILER_LAUNCHER}});
  run({{CMAKE, "--build", build}});
  const CommandResult passed = run({.argv = {CTEST, "--test-dir", build, "--output-on-failure"},
                                    .environment = {{"LAUNCH_PROGRAM", LAUNCH_PROGRAM}}});
  EXPECT_THAT(passed.out, HasSubstr("100% tests passed, 0 tests failed out of 1"));

  // The test fails when the system can't be started, and says why.
  const CommandResult failed =
      run({.argv = {build + "/ping_pong_test"}, .environment = {{"LAUNCH_PROGRAM", "/nonexistent/launch"}}}, 1);
  EXPECT_THAT(failed.out, HasSubstr("cannot start '/nonexistent/launch': No such file or directory"));
}

#ifdef PYTHON
TEST_F(InstalledTesting, ServesTheExampleInPython) {
  const std::map<std::string, std::string> environment{{"LAUNCH_PROGRAM", LAUNCH_PROGRAM},
                                                       {"PYTHONPATH", (prefix_ / PYTHON_MODULE_DESTINATION).string()},
                                                       {"PYTHONDONTWRITEBYTECODE", "1"}};
  const std::vector<std::string> import_pytest{PYTHON, "-c", "import pytest"};
  if (run_command(import_pytest).exit_code != 0) {
    GTEST_SKIP() << "pytest is not installed";
  }
  const CommandResult passed =
      run({.argv = {PYTHON, "-m", "pytest", "-p", "no:cacheprovider", kExample + "/test_ping_pong.py"},
           .environment = environment});
  EXPECT_THAT(passed.out, HasSubstr("1 passed"));

  // A failure shows the nearest events, and the files of the run stay.
  const fs::path wrong = sandbox_.directory() / "test_wrong.py";
  std::ofstream(wrong) << "from launch_trace_testing import event\n"
                          "def test_wrong(traced_launch):\n"
                          "    trace = traced_launch(\"" EXAMPLES_DIRECTORY
                          "/01_ping_pong.launch.xml\", count=2)\n"
                          "    trace.expect(event('ros2:rcl_publisher_init', topic_name='/pang'))\n";
  const CommandResult failed =
      run({.argv = {PYTHON, "-m", "pytest", "-p", "no:cacheprovider", wrong.string()}, .environment = environment}, 1);
  EXPECT_THAT(failed.out, HasSubstr("expected: at least 1 'ros2:rcl_publisher_init' with topic_name = \"/pang\""));
  EXPECT_THAT(failed.out, HasSubstr("ros2:rcl_publisher_init  topic_name=\"/ping\""));
  const std::string said = "the files of the run are in ";
  ASSERT_THAT(failed.out, HasSubstr(said));
  const std::size_t begin = failed.out.find(said) + said.size();
  EXPECT_TRUE(fs::exists(failed.out.substr(begin, failed.out.find('\n', begin) - begin)));
}
#endif

}  // namespace
