// SPDX-License-Identifier: Apache-2.0
// Launch files that are shown: as a tree, as one launch of several, as a script.
#include <gmock/gmock.h>

#include "tests/e2e/language/without_running.hpp"

namespace {

using namespace test_support;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(WithoutRunning, PrintShowsTheTreeWithIncludedFiles) {
  const std::string inner =
      file("inner.launch.yaml", "launch:\n  - node: {pkg: p, exec: e, param: [{name: n, value: [1, 2]}]}\n");
  const std::string outer =
      file("outer.launch.xml",
           "<launch><group><include file=\"$(dirname)/inner.launch.yaml\"/></group><shutdown/></launch>\n");
  const CommandResult result = launch({"--print", outer});
  EXPECT_EQ(result.out, outer +
                            "\n"
                            "├── group\n"
                            "│   └── include file=\"$(dirname)/inner.launch.yaml\"\n"
                            "│       └── " +
                            inner +
                            "\n"
                            "│           └── node pkg=\"p\" exec=\"e\"\n"
                            "│               └── param name=\"n\" value=\"[1, 2]\"\n"
                            "└── shutdown\n");
  EXPECT_EQ(
      launch({"--print", "--show-args", outer}).err,
      "launch: error: --dry-run, --show-args and --print exclude each other\n      = help: see 'launch --help'\n");
}

TEST_F(WithoutRunning, SeveralFilesAreOneLaunch) {
  const std::string first = file("first.launch.xml", "<launch><let name=\"x\" value=\"1\"/></launch>\n");
  const std::string second = file("second.launch.yaml", "launch:\n  - log: {message: \"x is $(var x)\"}\n");
  const CommandResult result = launch({first, second});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("x is 1"));
  EXPECT_EQ(launch({first, "nowhere.launch.xml"}).err,
            "launch: error: malformed launch argument 'nowhere.launch.xml', expected format '<name>:=<value>'\n"
            "      = help: nor is it a further launch file: no such file\n");
}

TEST_F(WithoutRunning, StandardInputIsALaunchFile) {
  const std::string command =
      "echo '<launch><log message=\"in $(dirname)\"/><log mesage=\"\"/></launch>' | '" LAUNCH_PROGRAM "' --dry-run -";
  const CommandResult result = run_command(Command{{"/bin/sh", "-c", command}, {}, sandbox_.directory()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, StartsWith("standard input:1:44: error: unexpected attribute 'mesage' in 'log'\n"));
}

TEST_F(WithoutRunning, DryRunAsAScriptRunsTheProcesses) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <set_env name="GREETING" value="it's"/>
  <unset_env name="UNWANTED"/>
  <executable cmd="/bin/sh -c 'echo $0 $GREETING ${UNWANTED-gone}; pwd' &quot;two words&quot;" cwd="/"/>
  <executable cmd="echo \$((1 + 1))" shell="true"/>
</launch>
)xml");
  CommandResult script = run_command(Command{{LAUNCH_PROGRAM, "--dry-run=shell", path}, {{"UNWANTED", "there"}}});
  EXPECT_EQ(script.exit_code, 0) << script.err;
  const std::string saved = file("run.sh", script.out);
  const CommandResult result = run_command(Command{{"/bin/sh", saved}, {{"UNWANTED", "there"}}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("two words it's gone\n"));
  EXPECT_THAT(result.out, HasSubstr("/\n"));
  EXPECT_THAT(result.out, HasSubstr("2\n"));  // they run at the same time, so the order is open
}

TEST_F(WithoutRunning, DryRunAsAScriptSaysWhatTheLaunchWouldDoBeyondIt) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <executable cmd="sleep 100" name="first" respawn="true"/>
  <executable cmd="true" name="second"><depends_on process="first" condition="started"/></executable>
  <timer period="1.5"><executable cmd="true" name="third" required="true"/></timer>
</launch>
)xml");
  const CommandResult script = launch({"--dry-run=shell", path});
  EXPECT_THAT(script.out, ContainsRegex("\n# first, [^\n]*\n# the launch starts it again when it has ended\n\\("));
  EXPECT_THAT(script.out, ContainsRegex("\n# second, [^\n]*\n# the launch waits until 'first' has started\n\\("));
  EXPECT_THAT(script.out,
              ContainsRegex("\n# third, [^\n]*\n# the launch starts it after 1.5 s\n# the launch ends with it\n\\("));
}

// What is in the background of a script ignores SIGINT.
TEST_F(WithoutRunning, CtrlCEndsAllOfAScript) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <executable cmd="sleep 1000"/>
  <executable cmd="sh -c 'echo ready; exec sleep 1000'"/>
</launch>
)xml");
  const std::string saved = file("run.sh", launch({"--dry-run=shell", path}).out);
  const CommandResult result = run_command(Command{{"/usr/bin/python3", "-c", R"py(
import os, signal, subprocess, sys
script = subprocess.Popen(['/bin/sh', sys.argv[1]], stdout=subprocess.PIPE, text=True, process_group=0)
script.stdout.readline()
os.killpg(script.pid, signal.SIGINT)
script.stdout.read()  # ends with the last process
print(script.wait())
)py",
                                                    saved}});
  EXPECT_EQ(result.out, "130\n") << result.err;
}

TEST_F(WithoutRunning, DryRunAsAScriptWritesParameterFiles) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" launch-prefix="/bin/echo"><param name="rate" value="20"/></node>
</launch>
)xml");
  const CommandResult script = launch({"--dry-run=shell", path});
  EXPECT_THAT(script.out, HasSubstr("rate: 20\n"));
  EXPECT_THAT(script.out, HasSubstr("trap 'rm -rf \"$parameters\"' EXIT\n"));
  const CommandResult result = run_command(Command{{"/bin/sh", file("run.sh", script.out)}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("--params-file"));
}

}  // namespace
