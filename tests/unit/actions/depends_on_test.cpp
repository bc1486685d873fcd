// SPDX-License-Identifier: Apache-2.0
// depends_on: the processes that it may name, and the errors for others.
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using test_support::Planned;
using testing::ElementsAre;

std::vector<std::string> conditions_of(const Planned& planned) {
  std::vector<std::string> texts;
  for (const launch::Dependency& dependency : planned.plan.dependencies) {
    texts.push_back(describe(dependency));
  }
  return texts;
}

TEST(DependsOn, NamesWhatTheGraphShowsBelowTheNamespaceOfTheScope) {
  const Planned planned = plan_actions(R"xml(
    <push_ros_namespace namespace="left"/>
    <executable cmd="a"/>
    <executable cmd="planner">
      <depends_on process="a"/>
      <depends_on service="map_server/get_map"/>
      <depends_on topic="/scan"/>
      <depends_on topic="scan" condition="message"/>
      <depends_on node="driver"/>
      <depends_on node="/driver" state="active"/>
      <depends_on node="/nobody" if="false"/>
    </executable>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(conditions_of(planned), ElementsAre("'a' has started", "service '/left/map_server/get_map' is offered",
                                                  "topic '/scan' is published", "a message has come on '/left/scan'",
                                                  "node '/left/driver' is there", "'/driver' is active"));
}

TEST(DependsOn, MeansTheSameInYaml) {
  const Planned planned = plan_text(R"(launch:
- executable:
    cmd: planner
    depends_on:
    - {topic: scan, condition: message, timeout: 1.5}
    - {node: driver, state: active}
)");
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(conditions_of(planned), ElementsAre("a message has come on '/scan'", "'/driver' is active"));
  EXPECT_EQ(planned.plan.dependencies[0].timeout, std::chrono::milliseconds(1500));
}

std::string error_of_dependency(const std::string& attributes) {
  return plan_actions("<executable cmd=\"a\"><depends_on " + attributes + "/></executable>").error;
}

TEST(DependsOn, NamesOneThing) {
  EXPECT_EQ(error_of_dependency(""),
            "/test/system.launch.xml:2:22: error: it is not said what is waited for\n"
            "    2 | <executable cmd=\"a\"><depends_on /></executable>\n"
            "      |                      ^~~~~~~~~~\n"
            "      = help: give process, node, topic or service");
  EXPECT_EQ(error_of_dependency(R"(topic="t" process="p")"),
            "/test/system.launch.xml:2:40: error: either a process or a topic is waited for\n"
            "    2 | <executable cmd=\"a\"><depends_on topic=\"t\" process=\"p\"/></executable>\n"
            "      |                                        ^\n"
            "      = help: write one for each");
}

TEST(DependsOn, ConditionsAreThoseOfTheirSubject) {
  EXPECT_EQ(error_of_dependency(R"(topic="t" condition="mesage")"),
            "/test/system.launch.xml:2:54: error: condition can be present or message, got 'mesage'\n"
            "    2 | <executable cmd=\"a\"><depends_on topic=\"t\" condition=\"mesage\"/></executable>\n"
            "      |                                                      ^~~~~~\n"
            "      = help: did you mean 'message'?");
  EXPECT_EQ(error_of_dependency(R"(service="s" condition="started")"),
            "/test/system.launch.xml:2:56: error: condition can be present, got 'started'\n"
            "    2 | <executable cmd=\"a\"><depends_on service=\"s\" condition=\"started\"/></executable>\n"
            "      |                                                        ^~~~~~~");
  EXPECT_EQ(error_of_dependency(R"(service="s" state="active")"),
            "/test/system.launch.xml:2:52: error: state goes with a node only\n"
            "    2 | <executable cmd=\"a\"><depends_on service=\"s\" state=\"active\"/></executable>\n"
            "      |                                                    ^~~~~~");
  EXPECT_EQ(error_of_dependency(R"(node="n" state="activ")"),
            "/test/system.launch.xml:2:49: error: state can be unconfigured, inactive, active or finalized, got "
            "'activ'\n"
            "    2 | <executable cmd=\"a\"><depends_on node=\"n\" state=\"activ\"/></executable>\n"
            "      |                                                 ^~~~~\n"
            "      = help: did you mean 'active'?");
  EXPECT_EQ(error_of_dependency(R"(topic="a b")"),
            "/test/system.launch.xml:2:40: error: 'a b' is no valid name\n"
            "    2 | <executable cmd=\"a\"><depends_on topic=\"a b\"/></executable>\n"
            "      |                                        ^~~\n"
            "      = help: each part is letters, digits and underscores, not starting with a digit");
}

TEST(WaitFor, IsAHandlerThatIsVisitedOnce) {
  const Planned planned = plan_actions(R"xml(
    <push_ros_namespace namespace="left"/>
    <wait_for node="driver" state="inactive">
      <lifecycle_transition node="driver" transitions="activate"/>
    </wait_for>)xml");
  ASSERT_EQ(planned.error, "");
  ASSERT_EQ(planned.plan.handlers.size(), 1U);
  EXPECT_EQ(describe(planned.plan.handlers[0]), "once '/left/driver' is inactive");
  EXPECT_EQ(plan_actions("<wait_for><shutdown/></wait_for>").error,
            "/test/system.launch.xml:2:2: error: it is not said what is waited for\n"
            "    2 | <wait_for><shutdown/></wait_for>\n"
            "      |  ^~~~~~~~\n"
            "      = help: give node, topic or service");
}

}  // namespace
