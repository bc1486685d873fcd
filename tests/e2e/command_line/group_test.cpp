// SPDX-License-Identifier: Apache-2.0
// Groups of processes that a launch file names, and the debugger commands, on real processes.
#include <gmock/gmock.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/command_line/control_fixture.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

using Groups = Control;

const std::string kArm = R"xml(<executable name="base" cmd="sleep 1000"/>
<group name="arm"><executable name="joint" cmd="sleep 1000"/>
  <group name="gripper"><executable name="finger" cmd="sleep 1000"/></group>
  <timer period="0.0"><executable name="late" cmd="sleep 1000"/></timer></group>)xml";

TEST_F(Groups, AreCompletedAndSoIsWhatIsScalable) {
  RunningCommand run(launch({write(kArm + R"xml(<executable name="worker" cmd="sleep 1000" scalable="true"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[late-5]: process started", kPatience)) << run.err();
  for (const char* const command : {"stop", "start", "restart", "ps"}) {
    EXPECT_EQ(ask({"complete", command, "--group", ""}).out, "arm\ngripper\n") << command;
  }
  EXPECT_EQ(ask({"complete", "stop", "--group", "g"}).out, "gripper\n");
  EXPECT_EQ(ask({"complete", "stop", "--group", "arm", "ba"}).out, "base\nbase-1\n");
  EXPECT_EQ(ask({"complete", "scale", ""}).out, "worker\nworker-4\n");
  EXPECT_EQ(ask({"complete", "scale", "worker", ""}).out, "");
  EXPECT_EQ(ps()["launches"][0]["processes"][3]["scalable"], true);
  EXPECT_FALSE(ps()["launches"][0]["processes"][0].contains("scalable"));
  run.send_signal(SIGINT);
  run.wait(kPatience);
}

TEST_F(Groups, AreStoppedAndStartedWithTheGroupsWithin) {
  RunningCommand run(launch({write(kArm)}));
  ASSERT_TRUE(run.wait_for_output("[late-4]: process started", kPatience)) << run.err();
  const CommandResult listed = ask({"ps", "--group", "gripper"});
  EXPECT_THAT(listed.out, HasSubstr("finger-3"));
  EXPECT_THAT(listed.out, Not(HasSubstr("joint-2")));
  EXPECT_EQ(ps()["launches"][0]["processes"][2]["groups"], json::array({"arm", "gripper"}));

  const CommandResult stopped = ask({"stop", "--group", "arm"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  for (const char* const name : {"joint-2", "finger-3", "late-4"}) {
    EXPECT_THAT(stopped.out, HasSubstr(std::string(name) + " has ended: SIGINT")) << name;
  }
  EXPECT_THAT(stopped.out, Not(HasSubstr("base")));
  const CommandResult started = ask({"start", "--group", "gripper", "joint"});
  EXPECT_EQ(started.exit_code, 0) << started.err;
  EXPECT_THAT(started.out, ContainsRegex("joint-2 has started"));
  EXPECT_THAT(started.out, ContainsRegex("finger-3 has started"));
  EXPECT_EQ(ask({"restart", "--group", "grip*"}).exit_code, 0);

  const CommandResult unknown = ask({"stop", "--group", "griper"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_EQ(unknown.err,
            "launch stop: error: no group with processes is named 'griper'\n      = help: did you mean 'gripper'?\n");
  const CommandResult nothing = ask({"stop"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(
      nothing.err,
      HasSubstr(
          "launch stop: error: NAME is required\n      = help: --group means a whole group of the launch file\n"));
  run.send_signal(SIGINT);
  run.wait(kPatience);
}

TEST_F(Groups, ANameThatIsNoneIsAnErrorAtItsPlace) {
  const CommandResult result = ask({write(R"xml(<group name="left arm"/>)xml")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("system.launch.xml:2:14: error: 'left arm' is no name for a group\n"
                        "    2 | <group name=\"left arm\"/>\n"
                        "      |              ^~~~~~~~\n"
                        "      = help: use a name without blanks, commas and the characters of shell patterns\n"));
}

using Debugging = Control;

TEST_F(Debugging, StackShowsWhatTheThreadsOfAProcessDo) {
  if (run_command({.argv = {"sh", "-c", "command -v gdb"}}, kPatience).exit_code != 0) {
    GTEST_SKIP() << "skipped, because gdb is not installed";
  }
  RunningCommand run(launch({write(R"xml(<executable name="a" shell="true" cmd="sleep 1000; true"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[a-1]: process started", kPatience)) << run.err();
  CommandResult stack = ask({"stack", "a"});
  if (stack.err.find("ptrace") != std::string::npos) {
    GTEST_SKIP() << "skipped, because no debugger may attach here: " << stack.err;
  }
  EXPECT_EQ(stack.exit_code, 0) << stack.err;
  // The program, not the shell in front of it.
  EXPECT_THAT(stack.out, MatchesRegex("a-1: pid [0-9]+, [^\n]*/sleep\n(.|\n)*#0 (.|\n)*"));
  EXPECT_EQ(ps()["launches"][0]["processes"][0]["state"], "running");
  run.send_signal(SIGINT);
  run.wait(kPatience);
}

TEST_F(Debugging, WhatIsMissingIsNamedWithItsRemedy) {
  RunningCommand run(
      launch({write(R"xml(<executable name="a" cmd="sleep 1000"/><executable name="b" cmd="true"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[a-1]: process started", kPatience)) << run.err();
  environment_["PATH"] = "/nowhere";
  const CommandResult stack = ask({"stack", "a"});
  EXPECT_EQ(stack.exit_code, 1);
  EXPECT_EQ(stack.err,
            "launch stack: error: neither gdb nor eu-stack is installed\n"
            "      = help: the packages gdb and elfutils have them: sudo apt install gdb\n");
  const CommandResult gdb = ask({"gdb", "a"});
  EXPECT_EQ(gdb.exit_code, 1);
  EXPECT_EQ(gdb.err,
            "launch gdb: error: gdb is not installed\n"
            "      = help: the package gdb has it: sudo apt install gdb\n");
  ASSERT_TRUE(run.wait_for_output("[b-2]: process has finished", kPatience));
  EXPECT_EQ(ask({"gdb", "b"}).err, "launch gdb: error: 'b' does not run\n      = help: launch start starts it\n");
  EXPECT_EQ(ask({"gdb", "*"}).err,
            "launch gdb: error: gdb is not installed\n"
            "      = help: the package gdb has it: sudo apt install gdb\n");
  EXPECT_EQ(ask({"gdb"}).exit_code, 2);
  run.send_signal(SIGINT);
  run.wait(kPatience);
}

}  // namespace
