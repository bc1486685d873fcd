// SPDX-License-Identifier: Apache-2.0
// <trace python-nodes="true">: nodes in Python, on a stand-in that has the shape of rclpy.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

class PythonNodes : public testing::Test {
 protected:
  // Launches a command of Python. Modules of the user are in the directory of the sandbox.
  CommandResult launch(const std::string& attributes, const std::string& command) const {
    const fs::path file = sandbox_.directory() / "system.launch.xml";
    write_file(file, "<launch>\n<trace session-name=\"run\" " + attributes +
                         "/>\n<executable name=\"py\" output=\"screen\" cmd=\"" + command +
                         "\">\n<env name=\"PYTHONPATH\" value=\"" + sandbox_.directory().string() + ":" + PYTHON_NODES +
                         "\"/>\n<env name=\"LD_LIBRARY_PATH\" value=\"" + PREFIX + "/lib\"/>\n" +
                         "<env name=\"PYTHONDONTWRITEBYTECODE\" value=\"1\"/>\n</executable>\n</launch>\n");
    return run_command({LAUNCH_PROGRAM, file.string()});
  }

  // "NODE OWNER SYMBOL COUNT" of each callback.
  std::vector<std::string> callbacks() const {
    const CommandResult told =
        run_command({LAUNCH_PROGRAM, "report", "--json", (sandbox_.trace_directory() / "run").string()});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    std::vector<std::string> callbacks;
    const json report = json::parse(told.out);
    for (const json& callback : report["callbacks"]) {
      callbacks.push_back(callback["node"].get<std::string>() + " " + callback["owner"].get<std::string>() + " " +
                          callback["symbol"].get<std::string>() + " " +
                          std::to_string(callback["duration"]["count"].get<std::uint64_t>()));
    }
    return callbacks;
  }

  const std::string talker_ = std::string("/usr/bin/python3 ") + PYTHON_NODES + "/talker.py";
  Sandbox sandbox_;
};

TEST_F(PythonNodes, TheReportHasTheirCallbacks) {
  const CommandResult result = launch("python-nodes=\"true\"", talker_);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("all was executed"));
  EXPECT_THAT(result.out, Not(HasSubstr("WARNING")));
  // The service pauses once in each request. A child that the program forks executes a timer once more.
  EXPECT_THAT(callbacks(),
              UnorderedElementsAre("/py_talker timer Talker.talk 101", "/py_talker subscription Talker.order 100",
                                   "/py_talker service Talker.add 200", "/py_talker timer Talker.fail 100"));
}

TEST_F(PythonNodes, WithoutTheAttributeNothingChanges) {
  const CommandResult result = launch("", talker_);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(callbacks(), IsEmpty());
}

TEST_F(PythonNodes, ASitecustomizeOfTheUserRuns) {
  write_file(sandbox_.directory() / "sitecustomize.py", "import sys\nsys.users_own = __file__\n");
  write_file(sandbox_.directory() / "app.py",
             "import sitecustomize, sys\nprint(sys.users_own == sitecustomize.__file__, 'is its own')\n");
  const CommandResult result =
      launch("python-nodes=\"true\"", "/usr/bin/python3 " + (sandbox_.directory() / "app.py").string());
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("True is its own"));
}

TEST_F(PythonNodes, AnotherShapeOfRclpyStaysAsItIs) {
  fs::create_directory(sandbox_.directory() / "rclpy");
  write_file(sandbox_.directory() / "rclpy/__init__.py", "");
  write_file(sandbox_.directory() / "rclpy/timer.py", "class Timer:\n  def __init__(self, action):\n    action()\n");
  write_file(sandbox_.directory() / "rclpy/node.py", "Node = None\n");
  write_file(sandbox_.directory() / "app.py",
             "import rclpy.node, rclpy.timer\nrclpy.timer.Timer(lambda: print('works'))\n");
  const CommandResult result =
      launch("python-nodes=\"true\"", "/usr/bin/python3 " + (sandbox_.directory() / "app.py").string());
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("works"));
}

TEST_F(PythonNodes, AnIsolatedPythonIsNamed) {
  const CommandResult result = launch("python-nodes=\"true\"", "/usr/bin/python3 -uI -c 'print(1)'");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("[WARNING] [launch.trace]: python-nodes has no effect on these processes: py (its "
                                    "Python has the option -I)"));
}

TEST_F(PythonNodes, AWrongValueIsAnErrorAtItsPlace) {
  const CommandResult result = launch("python-nodes=\"maybe\"", talker_);
  EXPECT_NE(result.exit_code, 0);
  EXPECT_EQ(result.err, (sandbox_.directory() / "system.launch.xml").string() +
                            ":2:41: error: expected a boolean, got 'maybe'\n"
                            "    2 | <trace session-name=\"run\" python-nodes=\"maybe\"/>\n"
                            "      |                                         ^~~~~\n"
                            "      = help: write true or false\n");
}

}  // namespace
