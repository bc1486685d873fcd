// SPDX-License-Identifier: Apache-2.0
// `launch complete`, and the completion of bash, which asks it.
#include <gmock/gmock.h>

#include "tests/e2e/language/without_running.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(WithoutRunning, CompletionKnowsCommandsPackagesFilesAndArguments) {
  EXPECT_EQ(launch({"complete", "che"}).out, "check\n");
  EXPECT_THAT(launch({"complete", ""}).out, HasSubstr("demo_nodes\n"));
  EXPECT_THAT(launch({"complete", "launch_examples", "01"}).out, "01_ping_pong.launch.xml\n01_ping_pong.launch.yaml\n");
  EXPECT_EQ(launch({"complete", "launch_examples", "01_ping_pong.launch.xml", ""}).out, "count:=\nperiod_ms:=\n");
  EXPECT_EQ(launch({"complete", "check", "launch_examples", "01_ping_pong.launch.xml", "c"}).out, "count:=\n");
  EXPECT_EQ(launch({"complete", "trace", "re"}).out, "read\nrecord_snapshot\nresume\n");
  EXPECT_EQ(launch({"complete", "trace", "start", "x", "--subbuffer-size"}).out,
            "--subbuffer-size-kernel\n--subbuffer-size-ust\n");
  EXPECT_EQ(launch({"complete", "trace", "stop", "--f"}).out, "--fail-on-loss\n");
  EXPECT_EQ(launch({"complete", "trace", "start", "x", "-u", "ros2:rcl_i", "ros2:rcl_n"}).out, "ros2:rcl_node_init\n");
  EXPECT_EQ(launch({"complete", "trace", "-c", "vt"}).out, "vtid\n");
  EXPECT_EQ(launch({"complete", "trace", "stop", ""}).out, "") << "no session daemon is started to ask it";
  EXPECT_EQ(launch({"complete", "no_such_package", ""}).out, "");
  const std::string path =
      file("a.launch.xml",
           "<launch><arg name=\"mode\" default=\"a\"><choice value=\"a\"/><choice value=\"b\"/></arg></launch>\n");
  EXPECT_EQ(launch({"complete", path, "mode:="}).out, "mode:=a\nmode:=b\n");
}

TEST_F(WithoutRunning, BashCompletesArguments) {
  const std::string script =
      file("complete.bash", "launch() { '" LAUNCH_PROGRAM
                            "' \"$@\"; }\n"
                            "source '" COMPLETION_SCRIPT
                            "'\n"
                            "COMP_LINE='launch launch_examples 01_ping_pong.launch.xml count:='\n"
                            "COMP_LINE=\"${COMP_LINE%:=}\"; COMP_POINT=${#COMP_LINE}; _launch\n"
                            "echo \"${COMPREPLY[@]}\"\n"
                            "COMP_LINE='launch launch_examples 0'; COMP_POINT=${#COMP_LINE}; _launch\n"
                            "echo \"${#COMPREPLY[@]} ${COMPREPLY[0]}\"\n");
  const CommandResult result = run_command(Command{{"/bin/bash", script}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("count:=\n"));
  EXPECT_THAT(result.out, HasSubstr(" 01_ping_pong.launch.xml\n"));
}

}  // namespace
