// SPDX-License-Identifier: Apache-2.0
// let, arg, group, conditions, log, timer, shutdown: what is visible where and when.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using test_support::Planned;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Scoping, GroupRestoresConfigurations) {
  const Planned planned = plan_actions(R"xml(
    <let name="v" value="o"/>
    <group><let name="v" value="i"/></group>
    <log message="$(var v)"/>)xml");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] o"));
}

TEST(Scoping, UnscopedGroupKeepsConfigurations) {
  const Planned planned = plan_actions(R"xml(
    <group scoped="false"><let name="v" value="i"/></group>
    <log message="$(var v)"/>)xml");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] i"));
}

TEST(Scoping, KeepIsPerformedBeforeForwardingFalseClears) {
  const Planned planned = plan_actions(R"xml(
    <let name="v" value="o"/>
    <group forwarding="false">
      <keep name="k" value="$(var v)"/>
      <log message="$(var k) $(var v none)"/>
    </group>)xml");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] o none"));
}

TEST(Scoping, GroupRestoresTheEnvironmentAndForwardingFalseResetsIt) {
  const Planned planned = plan_actions(R"xml(
    <set_env name="A" value="outer"/>
    <group><set_env name="A" value="inner"/><log message="$(env A)"/></group>
    <group forwarding="false"><log message="$(env A none)"/></group>
    <log message="$(env A)"/>
    <unset_env name="A"/>
    <log message="$(env A none)"/>)xml");
  EXPECT_THAT(planned.messages,
              ElementsAre("[launch.user] inner", "[launch.user] none", "[launch.user] outer", "[launch.user] none"));
}

TEST(Scoping, ArgKeepsAValueThatIsThere) {
  const Planned planned = plan_actions(R"xml(
    <arg name="a" default="1"/><arg name="a" default="$(var nothing)"/><log message="$(var a)"/>)xml");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] 1"));
}

TEST(Scoping, ArgDefaultSeesOnlyWhatIsSetBefore) {
  const std::string text =
      R"xml(<arg name="a" default="$(var b)"/><arg name="b" default="1"/><log message="$(var a)"/>)xml";
  EXPECT_NE(plan_actions(text).error, "");
  EXPECT_THAT(plan_actions(text, {.arguments = {{"a", "given"}}}).messages, ElementsAre("[launch.user] given"));
}

TEST(Scoping, RequiredArgumentIsNamedWithItsPlace) {
  EXPECT_EQ(plan_actions(R"xml(<arg name="robot"/>)xml").error,
            "/test/system.launch.xml:2:2: error: required launch argument \"robot\" was not provided\n"
            "    2 | <arg name=\"robot\"/>\n"
            "      |  ^~~\n"
            "      = help: give it on the command line: robot:=…");
}

TEST(Scoping, ChoicesAreCheckedForDefaultsToo) {
  const std::string text = R"xml(<arg name="c" default="z"><choice value="a"/><choice value="b"/></arg>)xml";
  EXPECT_EQ(plan_actions(text).error,
            "/test/system.launch.xml:2:2: error: argument \"c\" provided value \"z\" is not valid. Valid options are: "
            "['a', 'b']\n"
            "    2 | <arg name=\"c\" default=\"z\"><choice value=\"a\"/><choice value=\"b\"/></arg>\n"
            "      |  ^~~");
  EXPECT_EQ(plan_actions(text, {.arguments = {{"c", "b"}}}).error, "");
}

TEST(Conditions, FalseSkipsTheActionWithoutPerformingItsAttributes) {
  const Planned planned = plan_actions(R"xml(
    <log if="FALSE" message="$(var missing)"/>
    <log unless="1" message="$(var missing)"/>
    <group if="0"><log message="$(var missing)"/></group>
    <log if=" True " message="yes"/>)xml");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] yes"));
}

TEST(Conditions, OtherWordsAreErrors) {
  EXPECT_EQ(
      plan_actions(R"xml(<log if="yes" message="x"/>)xml").error,
      "/test/system.launch.xml:2:10: error: invalid condition expression, expected one of [true, 1, false, 0] but "
      "got 'yes'\n"
      "    2 | <log if=\"yes\" message=\"x\"/>\n"
      "      |          ^~~\n"
      "      = help: yes, on and the like are no conditions; an expression: $(eval '...')");
}

TEST(Conditions, IfAndUnlessExcludeEachOther) {
  EXPECT_THAT(plan_actions(R"xml(<log if="1" unless="0" message="x"/>)xml").error,
              testing::HasSubstr("if and unless conditions can't be used simultaneously"));
}

TEST(Timers, FireInOrderOfTheirTimesWithTheScopeOfTheirPlace) {
  const Planned planned = plan_actions(R"xml(
    <let name="v" value="outer"/>
    <group>
      <let name="v" value="inner"/>
      <timer period="2.0"><log message="second $(var v)"/></timer>
      <timer period="1"><log message="first $(var v)"/></timer>
    </group>
    <let name="v" value="changed"/>)xml");
  EXPECT_THAT(planned.messages, ElementsAre("[launch.user] first inner", "[launch.user] second inner"));
}

TEST(Timers, ShutdownEndsThePlan) {
  const Planned planned = plan_actions(R"xml(
    <timer period="1.0"><shutdown/><executable cmd="true"/></timer>
    <timer period="2.0"><log message="never"/></timer>)xml");
  EXPECT_EQ(planned.plan.shutdowns.size(), 1U);
  EXPECT_EQ(planned.plan.processes.size(), 1U);
  EXPECT_THAT(planned.messages, IsEmpty());
}

TEST(Timers, PeriodMustBeANumberThatIsNotNegative) {
  EXPECT_THAT(plan_actions(R"xml(<timer period="soon"/>)xml").error,
              testing::HasSubstr("expected a number, got 'soon'"));
  EXPECT_THAT(plan_actions(R"xml(<timer period="-1.0"/>)xml").error,
              testing::HasSubstr("expected a number that is not negative, got '-1.0'"));
  EXPECT_THAT(plan_text("launch:\n- timer: {period: 1, children: []}\n").error,
              testing::HasSubstr("attribute 'period' of 'timer' is expected to be of type float, got int"));
}

TEST(Logs, LevelsAreChecked) {
  EXPECT_THAT(plan_actions(R"xml(<log level="Warning" message="w"/>)xml").messages, ElementsAre("[launch.user] w"));
  for (const std::string level : {"warn", "WARN", "fatal", "NOTSET"}) {
    EXPECT_THAT(plan_actions("<log level=\"" + level + R"xml(" message="w"/>)xml").messages,
                ElementsAre("[launch.user] w"));
  }
  EXPECT_THAT(plan_actions(R"xml(<log level="warned" message="w"/>)xml").error,
              testing::HasSubstr("invalid log level 'warned', expected debug, info, warning, error or critical"));
}

TEST(Loading, EveryErrorOfAFileIsReported) {
  const Planned planned = plan_actions(R"xml(<lett name="a" value="b"/>
<let nme="a" value="b"/>
<log message="$(var"/>
<group scoped="perhaps"><log/></group>)xml");
  for (const char* const expected :
       {"/test/system.launch.xml:2:2: error: unrecognized entity of the type 'lett'", "did you mean 'let'?",
        "/test/system.launch.xml:3:6: error: unexpected attribute 'nme' in 'let'", "did you mean 'name'?",
        "/test/system.launch.xml:3:2: error: attribute 'name' not found in entity 'let'",
        "/test/system.launch.xml:4:", "/test/system.launch.xml:5:16: error: expected a boolean, got 'perhaps'",
        "/test/system.launch.xml:5:26: error: attribute 'message' not found in entity 'log'"}) {
    EXPECT_THAT(planned.error, testing::HasSubstr(expected));
  }
}

TEST(Loading, AnEmptyYamlListOfItemsHasNone) {
  const Planned planned = plan_text(
      "launch:\n- node: {exec: a, param: [], remap: [], env: []}\n- group: {keep: [], children: []}\n"
      "- arg: {name: b, default: c, choice: []}\n");
  EXPECT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.processes.size(), 1U);
  EXPECT_EQ(plan_text("launch:\n- node: {exec: a, param: [1]}\n").error,
            "/test/system.launch.yaml:2:19: error: expected 'param' of 'node' to be a list of mappings\n"
            "    2 | - node: {exec: a, param: [1]}\n"
            "      |                   ^~~~~\n"
            "      = help: leave it out when there is none");
}

TEST(Loading, ActionsUnderAnotherKeyThanChildrenAreExplained) {
  EXPECT_EQ(plan_text("launch:\n- group:\n    if: \"true\"\n    actions:\n    - log_info: {message: inside}\n").error,
            "/test/system.launch.yaml:4:5: error: unexpected key 'actions' in 'group'\n"
            "    4 |     actions:\n"
            "      |     ^~~~~~~\n"
            "      = help: did you mean 'children'? Actions stand there");
}

TEST(Loading, ConditionsAreNoAttributesOfItems) {
  EXPECT_THAT(plan_actions("<node exec=\"a\"><param name=\"p\" value=\"1\" if=\"true\"/></node>").error,
              testing::HasSubstr("unexpected attribute 'if' in 'param'"));
}

}  // namespace
