// SPDX-License-Identifier: Apache-2.0
// lifecycle_transition: the node, the transitions, and the errors for wrong ones.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using test_support::Planned;
using testing::ElementsAre;

TEST(LifecycleTransition, NamesANodeOfTheScopeAndItsTransitions) {
  const Planned planned = plan_actions(R"xml(
    <let name="last" value="activate"/>
    <set_env name="ROS_DOMAIN_ID" value="3"/>
    <group>
      <push_ros_namespace namespace="left"/>
      <lifecycle_transition node="arm/driver" transitions="configure $(var last)"/>
    </group>
    <lifecycle_transition node="/camera" transitions="shutdown"/>
    <lifecycle_transition node="camera" transitions="cleanup" if="false"/>)xml");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.transitions.size(), 2U);
  EXPECT_EQ(planned.plan.transitions[0].node, "/left/arm/driver");
  EXPECT_THAT(planned.plan.transitions[0].transitions, ElementsAre("configure", "activate"));
  EXPECT_EQ(planned.plan.transitions[0].environment.at("ROS_DOMAIN_ID"), "3");
  EXPECT_FALSE(planned.plan.transitions[0].autostart);
  EXPECT_EQ(planned.plan.transitions[1].node, "/camera");
  EXPECT_THAT(planned.plan.transitions[1].transitions, ElementsAre("shutdown"));
}

TEST(LifecycleTransition, MeansTheSameInYaml) {
  const Planned planned = plan_text(R"(launch:
- lifecycle_transition: {node: driver, transitions: configure activate}
)");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.transitions.size(), 1U);
  EXPECT_EQ(planned.plan.transitions[0].node, "/driver");
  EXPECT_THAT(planned.plan.transitions[0].transitions, ElementsAre("configure", "activate"));
}

TEST(LifecycleTransition, UnknownTransitionsAndInvalidNamesAreErrors) {
  EXPECT_EQ(plan_actions(R"xml(<lifecycle_transition node="driver" transitions="configure actvate"/>)xml").error,
            "/test/system.launch.xml:2:50: error: there is no transition 'actvate', expected configure, activate, "
            "deactivate, cleanup or shutdown\n"
            "    2 | <lifecycle_transition node=\"driver\" transitions=\"configure actvate\"/>\n"
            "      |                                                  ^~~~~~~~~~~~~~~~~\n"
            "      = help: did you mean 'activate'?");
  EXPECT_EQ(plan_actions(R"xml(<lifecycle_transition node="2nd" transitions="configure"/>)xml").error,
            "/test/system.launch.xml:2:29: error: '2nd' is no valid name\n"
            "    2 | <lifecycle_transition node=\"2nd\" transitions=\"configure\"/>\n"
            "      |                             ^~~\n"
            "      = help: each part is letters, digits and underscores, not starting with a digit");
  EXPECT_EQ(plan_actions(R"xml(<lifecycle_transition node="n" transitions=" "/>)xml").error,
            "/test/system.launch.xml:2:45: error: transitions names none\n"
            "    2 | <lifecycle_transition node=\"n\" transitions=\" \"/>\n"
            "      |                                             ^\n"
            "      = help: configure, activate, deactivate, cleanup or shutdown, separated by spaces");
}

}  // namespace
