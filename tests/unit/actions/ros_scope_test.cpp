// SPDX-License-Identifier: Apache-2.0
// push_ros_namespace, set_parameter, set_parameters_from_file, set_remap: what a scope gives to its nodes, and when
// this ends.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::Planned;
using testing::ElementsAre;
using testing::HasSubstr;

using Words = std::vector<std::string>;

TEST(RosScope, AParameterMayBeAListOrANumberInYaml) {
  const Planned planned = test_support::plan_text(
      "launch:\n- let: {name: lat, value: \"48.5\"}\n"
      "- set_parameter: {name: a, value: [$(var lat), 9.25, 0.0]}\n"
      "- set_parameter: {name: b, value: [x, y]}\n- set_parameter: {name: c, value: 5}\n"
      "- set_parameter: {name: d, value: true}\n- set_parameter: {name: e, value: \"[1, 2]\"}\n- node: {exec: n}\n");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.processes.at(0).argv,
              testing::ElementsAre("n", "--ros-args", "-p", "a:=[48.5, 9.25, 0.0]", "-p", "b:=[\"x\", \"y\"]", "-p",
                                   "c:=5", "-p", "d:=True", "-p", "e:=[1, 2]"));
  EXPECT_EQ(test_support::plan_text("launch:\n- set_parameter: {name: a, value: [1, x]}\n").error,
            "/test/system.launch.yaml:2:35: error: the result is a non-uniform list\n"
            "    2 | - set_parameter: {name: a, value: [1, x]}\n"
            "      |                                   ^\n"
            "      = help: use a bool, an int, a float, a string, or a list of one of them");
}

TEST(RosScope, NamespacesCombineAndEndWithTheirGroup) {
  const Planned planned = plan_actions(R"xml(
    <group>
      <push_ros_namespace namespace="a"/><push-ros-namespace namespace="b"/>
      <node exec="n"/><node exec="n" namespace="c"/><node exec="n" namespace="/d/"/>
    </group>
    <node exec="n"/>)xml");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.processes.size(), 4U);
  EXPECT_THAT(planned.plan.processes[0].argv, ElementsAre("n", "--ros-args", "-r", "__ns:=/a/b"));
  EXPECT_THAT(planned.plan.processes[1].argv, ElementsAre("n", "--ros-args", "-r", "__ns:=/a/b/c"));
  EXPECT_THAT(planned.plan.processes[2].argv, ElementsAre("n", "--ros-args", "-r", "__ns:=/d"));
  EXPECT_THAT(planned.plan.processes[3].argv, ElementsAre("n", "--ros-args"));
}

TEST(RosScope, AnInvalidNamespaceIsAnErrorWhereItIsPushed) {
  EXPECT_EQ(plan_actions(R"xml(<push_ros_namespace namespace="1st"/>)xml").error,
            "/test/system.launch.xml:2:32: error: the resulting namespace is invalid: '/1st'\n"
            "    2 | <push_ros_namespace namespace=\"1st\"/>\n"
            "      |                                ^~~\n"
            "      = help: each part is letters, digits and underscores, not starting with a digit");
}

TEST(RosScope, GlobalParametersAndRemapsPrecedeThoseOfTheNode) {
  const Planned planned = plan_actions(R"xml(
    <set_remap from="a" to="b"/>
    <set_parameter name="use_sim_time" value="true"/>
    <node exec="n" name="x" namespace="y"><remap from="c" to="d"/><param from="/etc/hostname"/></node>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes[0].argv,
            (Words{"n", "--ros-args", "-r", "__node:=x", "-r", "__ns:=/y", "-p", "use_sim_time:=True", "--params-file",
                   "/etc/hostname", "-r", "a:=b", "-r", "c:=d"}));
}

TEST(RosScope, ParameterArgumentsReadBackAsTheTypeThatWasSet) {
  const Planned planned = plan_actions(R"xml(
    <set_parameter name="a" value="[1, 2]"/><set_parameter name="b" value="1.0"/><set_parameter name="c" value="'1'"/>
    <set_parameter name="d" value=""/><set_parameter name="e" value="/plain/text"/><set_parameter name="f" value="1e3"/>
    <node exec="n"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes[0].argv,
            (Words{"n", "--ros-args", "-p", "a:=[1, 2]", "-p", "b:=1.0", "-p", "c:=\"1\"", "-p", "d:=\"\"", "-p",
                   "e:=/plain/text", "-p", "f:=\"1e3\""}));
}

TEST(RosScope, WhatAGroupSetsEndsWithItEvenIfSomethingWasSetBefore) {
  const Planned planned = plan_actions(R"xml(
    <set_parameter name="a" value="1"/><set_remap from="a" to="b"/>
    <group><set_parameter name="a" value="2"/><set_remap from="c" to="d"/></group>
    <node exec="n"/>
    <group scoped="false"><set_parameter name="b" value="3"/></group>
    <reset><keep name="k" value="kept"/></reset>
    <node exec="$(var k)"/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.processes[0].argv, ElementsAre("n", "--ros-args", "-p", "a:=1", "-r", "a:=b"));
  EXPECT_THAT(planned.plan.processes[1].argv, ElementsAre("kept", "--ros-args"));
}

TEST(RosScope, WhatIsNoParameterIsRefused) {
  for (const char* const value : {"~", "{a: 1}", "[1, a]", "[[1]]", "2024-01-01"}) {
    const std::string error = plan_actions("<set_parameter name=\"p\" value=\"" + std::string(value) + "\"/>").error;
    EXPECT_THAT(error, HasSubstr("/test/system.launch.xml:2:32: error: ")) << value;
  }
}

TEST(RosScope, AMissingParameterFileMattersOnlyToNodes) {
  const std::string set = R"xml(<set_parameters_from_file filename="/nowhere.yaml"/>)xml";
  EXPECT_EQ(plan_actions(set).error, "");
  EXPECT_EQ(plan_actions(set + "<node exec=\"n\"/>").error,
            "/test/system.launch.xml:2:37: error: parameter file path is not a file: /nowhere.yaml\n"
            "    2 | <set_parameters_from_file filename=\"/nowhere.yaml\"/><node exec=\"n\"/>\n"
            "      |                                     ^~~~~~~~~~~~~");
  const std::string empty = R"xml(<set_parameters_from_file filename="$(env NOT_SET '')"/>)xml";
  EXPECT_EQ(plan_actions(empty).error, "");
  EXPECT_THAT(plan_actions(empty + "<node exec=\"n\"/>").error,
              HasSubstr("error: parameter file path is not a file: \n"));
}

TEST(RosScope, LogDirectoryIsJoinedToTheCurrentOne) {
  const Planned planned = plan_actions(R"xml(
    <set_ros_log_dir new_log_dir="run"/><log message="$(env ROS_LOG_DIR)"/>
    <set_ros_log_dir new_log_dir="more"/><log message="$(env ROS_LOG_DIR)"/>
    <set_ros_log_dir new_log_dir="/abs"/><log message="$(env ROS_LOG_DIR)"/>)xml");
  EXPECT_THAT(planned.plan.logs, ElementsAre("/home/user/.ros/log/run", "/home/user/.ros/log/run/more", "/abs"));
}

TEST(RosScope, LifecycleNodesNeedTheirName) {
  EXPECT_THAT(plan_actions(R"xml(<lifecycle_node exec="n"/>)xml").error,
              HasSubstr("attribute 'name' not found in entity 'lifecycle_node'"));
  const Planned planned = plan_actions(R"xml(<lifecycle_node exec="n" name="x" namespace=""/>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.processes[0].argv, ElementsAre("n", "--ros-args", "-r", "__node:=x", "-r", "__ns:=/"));
}

}  // namespace
