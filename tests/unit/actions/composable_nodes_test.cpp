// SPDX-License-Identifier: Apache-2.0
// node_container and load_composable_node: the requests to load and to start.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using launch::ComposableNode;
using launch::NamedParameter;
using launch::ParameterScalar;
using test_support::plan_actions;
using test_support::Planned;
using test_support::run_error;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::vector<std::string> texts_of(const std::vector<NamedParameter>& parameters) {
  std::vector<std::string> texts;
  for (const NamedParameter& parameter : parameters) {
    texts.push_back(parameter.name + "=" + launch::to_python_text(parameter.value));
  }
  return texts;
}

TEST(ComposableNodes, ContainerLoadsThoseWhoseConditionHolds) {
  const Planned planned = plan_actions(R"xml(
    <push_ros_namespace namespace="left"/>
    <set_remap from="g" to="h"/>
    <set_parameter name="use_sim_time" value="true"/>
    <node_container exec="container" name="c" namespace="arm">
      <composable_node pkg="demo" plugin="demo::Talker" name="talker">
        <param name="rate" value="10"/><param name="g"><param name="h" value="x"/></param>
        <remap from="chatter" to="/out"/>
        <extra_arg name="use_intra_process_comms" value="true"/>
      </composable_node>
      <composable_node pkg="demo" plugin="demo::Listener" name="listener" if="false"/>
      <composable_node pkg="demo" plugin="demo::Listener" name="other" namespace="/abs" unless="false"/>
    </node_container>)xml");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.processes.size(), 1U);
  ASSERT_EQ(planned.plan.loads.size(), 1U);
  EXPECT_EQ(planned.plan.loads[0].target, "/left/arm/c");
  ASSERT_EQ(planned.plan.loads[0].nodes.size(), 2U);
  const ComposableNode& talker = planned.plan.loads[0].nodes[0];
  EXPECT_EQ(talker.package, "demo");
  EXPECT_EQ(talker.plugin, "demo::Talker");
  EXPECT_EQ(talker.name_space, "/left");  // not the namespace of the container
  EXPECT_THAT(texts_of(talker.parameters), ElementsAre("use_sim_time=True", "rate=10", "g.h=x"));
  EXPECT_THAT(talker.remaps, ElementsAre(Pair("g", "h"), Pair("chatter", "/out")));
  EXPECT_THAT(texts_of(talker.extra_arguments), ElementsAre("use_intra_process_comms=True"));
  EXPECT_EQ(planned.plan.loads[0].nodes[1].name_space, "/abs");
}

TEST(ComposableNodes, ParameterFilesGiveTheSectionsThatMatch) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("composable_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << "/**:\n  ros__parameters: {a: 1, n: {b: 2.5}}\n"
                         "/other:\n  ros__parameters: {a: 9}\n"
                         "ns:\n  talker:\n    ros__parameters: {a: 3, c: [x, y]}\n"
                         "/*/talker:\n  ros__parameters: {d: yes}\n";
  const Planned planned = plan_actions(R"xml(
    <load_composable_node target="c">
      <composable_node pkg="demo" plugin="demo::Talker" name="talker" namespace="ns"><param from=")xml" +
                                       path.string() +
                                       R"xml("/></composable_node>
    </load_composable_node>)xml");
  std::filesystem::remove(path);
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.loads.size(), 1U);
  EXPECT_EQ(planned.plan.loads[0].target, "c");
  EXPECT_THAT(texts_of(planned.plan.loads[0].nodes[0].parameters),
              ElementsAre("a=3", "n.b=2.5", "c=('x', 'y')", "d=True"));
}

TEST(ComposableNodes, AMissingParameterFileIsAnError) {
  EXPECT_THAT(plan_actions(R"xml(<load_composable_node target="c">
      <composable_node pkg="demo" plugin="demo::Talker" name="t"><param from="/nowhere.yaml"/></composable_node>
    </load_composable_node>)xml")
                  .error,
              HasSubstr("parameter file path is not a file: /nowhere.yaml"));
}

TEST(ComposableNodes, AutostartIsNotedForComponentsAndAskedForNodes) {
  const Planned planned = plan_actions(R"xml(
    <set_env name="ROS_DOMAIN_ID" value="7"/>
    <node_container exec="container" name="c" namespace="">
      <env name="ROS_DOMAIN_ID" value="8"/>
      <composable_lifecycle_node pkg="p" plugin="p::T" name="t" autostart="true"/>
      <composable_lifecycle_node pkg="p" plugin="p::T" name="u"/>
    </node_container>
    <load_composable_node target="c"><composable_node pkg="p" plugin="p::T" name="v"/></load_composable_node>
    <lifecycle_node exec="n" name="x" namespace="left" autostart="true"/>
    <lifecycle_node exec="n" name="y" namespace="left"/>)xml");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.loads.size(), 2U);
  EXPECT_TRUE(planned.plan.loads[0].nodes[0].autostart);
  EXPECT_FALSE(planned.plan.loads[0].nodes[1].autostart);
  EXPECT_EQ(planned.plan.loads[0].environment.at("ROS_DOMAIN_ID"), "8");  // the environment of the container
  EXPECT_EQ(planned.plan.loads[1].environment.at("ROS_DOMAIN_ID"), "7");
  ASSERT_EQ(planned.plan.transitions.size(), 1U);
  EXPECT_EQ(planned.plan.transitions[0].node, "/left/x");
  EXPECT_TRUE(planned.plan.transitions[0].autostart);
  EXPECT_THAT(planned.plan.transitions[0].transitions, ElementsAre("configure", "activate"));
  EXPECT_EQ(planned.plan.transitions[0].environment.at("ROS_DOMAIN_ID"), "7");
}

TEST(ComposableNodes, ItemsAreCheckedLikeActions) {
  EXPECT_THAT(plan_actions(R"xml(<load_composable_node target="c"/>)xml").error,
              HasSubstr("load_composable_node needs a composable_node"));
  EXPECT_THAT(plan_actions(R"xml(<load_composable_node target="c">
      <composable_node pkg="p" plugin="q" name="n" iff="1"><parm name="a" value="1"/></composable_node>
    </load_composable_node>)xml")
                  .error,
              testing::AllOf(
                  HasSubstr("unexpected attribute 'iff' in 'composable_node'"), HasSubstr("did you mean 'if'?"),
                  HasSubstr("unexpected nested tag 'parm' in 'composable_node'"), HasSubstr("did you mean 'param'?")));
}

TEST(PythonIncludes, ThatAreMissingAreNotedByAPlanAndRefusedByARun) {
  const std::string text = R"xml(<include file="/nowhere/x.launch.py"><arg name="a" value="1"/></include>)xml";
  const Planned planned = plan_actions(text + "<log message=\"$(var a)\"/>");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.plan.python_includes, ElementsAre("/nowhere/x.launch.py"));
  EXPECT_THAT(planned.plan.logs, ElementsAre("1"));
  EXPECT_EQ(
      run_error(text),
      "/test/system.launch.xml:2:16: error: can't read launch file '/nowhere/x.launch.py': No such file or directory\n"
      "    2 | " +
          text +
          "\n"
          "      |                ^~~~~~~~~~~~~~~~~~~~");
}

}  // namespace
