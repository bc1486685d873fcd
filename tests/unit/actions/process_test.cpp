// SPDX-License-Identifier: Apache-2.0
// <executable>: command lines, environment, and the attributes that it shares with <node>.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using launch::ProcessSpec;
using test_support::plan_actions;
using test_support::plan_text;
using testing::ElementsAre;
using testing::HasSubstr;

ProcessSpec only_process(const std::string& xml, const test_support::PlanOptions& options = {}) {
  test_support::Planned planned = plan_actions(xml, options);
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes.size(), 1U);
  return planned.plan.processes.empty() ? ProcessSpec() : planned.plan.processes.front();
}

TEST(Executable, CommandIsSplitBeforeSubstitution) {
  const ProcessSpec spec = only_process(R"xml(
    <let name="x" value="7"/><let name="sp" value="a b"/>
    <executable cmd="prog $(var sp) z --x=$(var x) pre$(var sp)post 'q r' &quot;&quot;"/>)xml");
  EXPECT_THAT(spec.argv, ElementsAre("prog", "a b", "z", "--x=7", "prea bpost", "q r", ""));
  EXPECT_EQ(spec.name, "prog");
}

TEST(Executable, DefaultsAreThoseOfRos2) {
  const ProcessSpec spec = only_process(R"xml(<executable cmd="/usr/bin/env"/>)xml");
  EXPECT_EQ(spec.name, "env");
  EXPECT_EQ(spec.working_directory, "");
  EXPECT_EQ(spec.output, *launch::OutputRouting::from_mode("log"));
  EXPECT_FALSE(spec.shell);
  EXPECT_FALSE(spec.emulate_tty);
  EXPECT_FALSE(spec.terminal_input);
  EXPECT_FALSE(spec.respawn.enabled);
  EXPECT_FALSE(spec.shutdown_on_exit);
  EXPECT_EQ(spec.sigterm_timeout, std::chrono::seconds(5));
  EXPECT_EQ(spec.sigkill_timeout, std::chrono::seconds(5));
  EXPECT_EQ(launch::to_string(spec.origin), "/test/system.launch.xml:2:2");
}

TEST(Executable, EveryAttributeIsTaken) {
  const ProcessSpec spec = only_process(R"xml(
    <executable cmd="prog a" name="label" cwd="/tmp" launch-prefix="nice -n '5'" output="full" respawn="yes"
                respawn_delay="0.25" respawn_max_retries="3" on_exit="shutdown" shell="true" emulate_tty="true"
                sigterm_timeout="1.5" sigkill_timeout="2" stdin="terminal">
      <env name="A" value="1"/>
    </executable>)xml");
  EXPECT_THAT(spec.argv, ElementsAre("nice", "-n", "5", "prog", "a"));
  EXPECT_EQ(spec.name, "label");
  EXPECT_EQ(spec.working_directory, "/tmp");
  EXPECT_EQ(spec.output, *launch::OutputRouting::from_mode("full"));
  EXPECT_TRUE(spec.respawn.enabled);
  EXPECT_EQ(spec.respawn.delay, std::chrono::milliseconds(250));
  EXPECT_EQ(spec.respawn.max_retries, 3);
  EXPECT_TRUE(spec.shutdown_on_exit);
  EXPECT_TRUE(spec.shell);
  EXPECT_TRUE(spec.emulate_tty);
  EXPECT_TRUE(spec.terminal_input);
  EXPECT_EQ(spec.sigterm_timeout, std::chrono::milliseconds(1500));
  EXPECT_EQ(spec.sigkill_timeout, std::chrono::seconds(2));
  EXPECT_EQ(spec.environment.at("A"), "1");
  EXPECT_EQ(spec.environment.at("HOME"), "/home/user");
}

TEST(Executable, ATerminalOfItsOwnIsAllThatItHas) {
  const ProcessSpec spec = only_process(R"xml(<executable cmd="prog" tty="true" stdout="log"/>)xml");
  EXPECT_TRUE(spec.tty);
  EXPECT_EQ(spec.environment.at("TERM"), "xterm") << "there was none";
  EXPECT_EQ(only_process(R"xml(<executable cmd="p" tty="true"><env name="TERM" value="dumb"/></executable>)xml")
                .environment.at("TERM"),
            "dumb");
  EXPECT_FALSE(only_process(R"xml(<executable cmd="p" tty="false" stdin="terminal" stderr="log"/>)xml").tty);
  EXPECT_EQ(plan_actions(R"xml(<executable cmd="prog" stdin="terminal" tty="true"/>)xml").error,
            "/test/system.launch.xml:2:31: error: a process with tty=\"true\" reads a terminal of its own, not that of "
            "the launch\n"
            "    2 | <executable cmd=\"prog\" stdin=\"terminal\" tty=\"true\"/>\n"
            "      |                               ^~~~~~~~\n"
            "      = help: leave out stdin or tty");
  EXPECT_EQ(
      plan_actions(R"xml(<executable cmd="prog" stderr="log" tty="true"/>)xml").error,
      "/test/system.launch.xml:2:32: error: stderr has no effect with tty=\"true\": what is printed on a terminal "
      "is one stream\n"
      "    2 | <executable cmd=\"prog\" stderr=\"log\" tty=\"true\"/>\n"
      "      |                                ^~~\n"
      "      = help: stdout says where it goes");
  EXPECT_EQ(plan_actions(R"xml(<executable cmd="prog" leave-running="true" tty="true"/>)xml").error,
            "/test/system.launch.xml:2:39: error: a process with tty=\"true\" can't be left running: its terminal ends "
            "with the launch\n"
            "    2 | <executable cmd=\"prog\" leave-running=\"true\" tty=\"true\"/>\n"
            "      |                                       ^~~~\n"
            "      = help: leave out leave-running or tty");
  EXPECT_EQ(plan_actions(R"xml(<node_container exec="c" name="c" namespace="">
  <composable_node pkg="p" plugin="q" name="n" tty="true"/></node_container>)xml")
                .error,
            "/test/system.launch.xml:3:48: error: unexpected attribute 'tty' in 'composable_node'\n"
            "    3 |   <composable_node pkg=\"p\" plugin=\"q\" name=\"n\" tty=\"true\"/></node_container>\n"
            "      |                                                ^~~\n"
            "      = help: 'composable_node' has pkg, plugin, name, namespace, if, unless");
}

TEST(Executable, ConfigurationsGiveDefaults) {
  const std::string xml = R"xml(<executable cmd="prog"/>)xml";
  EXPECT_THAT(only_process(xml, {.arguments = {{"launch-prefix", "gdb -ex run"}}}).argv,
              ElementsAre("gdb", "-ex", "run", "prog"));
  EXPECT_THAT(only_process(xml, {.arguments = {{"launch-prefix", "gdb"}, {"launch-prefix-filter", "ro"}}}).argv,
              ElementsAre("prog"));
  EXPECT_THAT(only_process(xml, {.arguments = {{"launch-prefix", "gdb"}, {"launch-prefix-filter", "p.o"}}}).argv,
              ElementsAre("gdb", "prog"));
  EXPECT_EQ(only_process(xml, {.arguments = {{"sigterm_timeout", "9"}}}).sigterm_timeout, std::chrono::seconds(9));
  EXPECT_TRUE(only_process(xml, {.arguments = {{"emulate_tty", "true"}}}).emulate_tty);
}

TEST(Executable, OutputModeCanBeOverriddenByTheEnvironment) {
  const test_support::PlanOptions options{.environment = {{"OVERRIDE_LAUNCH_PROCESS_OUTPUT", "both"}}};
  EXPECT_EQ(only_process(R"xml(<executable cmd="prog" output="log"/>)xml", options).output,
            *launch::OutputRouting::from_mode("both"));
}

TEST(Executable, WrongValuesAreErrorsAtTheirPlace) {
  EXPECT_EQ(
      plan_actions(R"xml(<executable cmd="prog" output="scren"/>)xml").error,
      "/test/system.launch.xml:2:32: error: 'scren' is not a valid output mode, expected screen, log, both, own_log "
      "or full\n"
      "    2 | <executable cmd=\"prog\" output=\"scren\"/>\n"
      "      |                                ^~~~~\n"
      "      = help: did you mean 'screen'?");
  EXPECT_THAT(plan_actions(R"xml(<executable cmd="prog" on_exit="restart"/>)xml").error,
              HasSubstr(":2:33: error: on_exit can only be 'shutdown', got 'restart'"));
  EXPECT_THAT(plan_actions(R"xml(<executable cmd="prog" respawn="maybe"/>)xml").error,
              HasSubstr(":2:33: error: respawn is expected to be a boolean, got 'maybe'"));
  EXPECT_THAT(plan_actions(R"xml(<executable cmd="prog" respawn_delay="-1"/>)xml").error,
              HasSubstr("expected a number that is not negative, got '-1'"));
  EXPECT_THAT(plan_actions(R"xml(<executable cmd=""/>)xml").error, HasSubstr("the command is empty"));
  EXPECT_THAT(plan_actions(R"xml(<executable cmd="prog"><arg name="a"/></executable>)xml").error,
              HasSubstr("unexpected nested tag 'arg' in 'executable'"));
  EXPECT_THAT(plan_text("launch:\n- executable: {cmd: prog, respawn: true}\n").error,
              HasSubstr("attribute 'respawn' of 'executable' is expected to be of type str, got bool"));
}

}  // namespace
