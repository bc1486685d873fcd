// SPDX-License-Identifier: Apache-2.0
// <message> of tests in launch files: messages that come, do not come, or cannot come.
#include <gmock/gmock.h>

#include <string>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

class ExpectedMessages : public LaunchTestFixture {
 protected:
  CommandResult run_file(const std::string& actions) { return run({write("a.launch.xml", actions), "-j", "1"}); }
};

constexpr const char* kPublisher = R"xml(
  <test name="publishes">
    <publish topic="/numbers" type="std_msgs/msg/Int64" values="{data: 7}" rate="50" count="0"/>
    <exit process="publish" when="shutdown" code="any"/>)xml";

TEST_F(ExpectedMessages, MessagesAreCountedByTheirFields) {
  const CommandResult good = run_file(std::string(kPublisher) + R"xml(
    <message topic="/numbers" type="std_msgs/Int64" where="data == 7" min="10" min_rate="10" max_rate="200" within="60"/>
    <message topic="/numbers" type="std_msgs/msg/Int64" where="data == 8" absent="true"/>
  </test>)xml");
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;

  const CommandResult bad = run_file(std::string(kPublisher) + R"xml(
    <message topic="/numbers" type="std_msgs/msg/Int64" where="data == 7"/>
    <message topic="/numbers" type="std_msgs/msg/Int64" max="2"/>
    <exit process="publish"/>
  </test>)xml");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out,
              HasSubstr("a.launch.xml:7:6: error: there are more than 2 messages of a message on '/numbers'\n"));
  EXPECT_THAT(bad.out, HasSubstr("      = expected: at most 2 times a message on '/numbers'\n"));
  EXPECT_THAT(bad.out, HasSubstr("      = last messages:\n          {data: 7}\n"));
}

// A test that says what must not come passes on no misspelt topic, and on none of another type.
TEST_F(ExpectedMessages, MessagesThatCannotComeAreNoneThatDoNot) {
  const CommandResult result = run_file(R"xml(
  <test name="nobody">
    <executable cmd="true" name="p"/><exit process="p"/>
    <message topic="/nowhere" type="std_msgs/msg/Int64" absent="true"/>
  </test>
  <test name="another type" timeout="3">
    <publish topic="/numbers" type="std_msgs/msg/Int64" values="{data: 7}" rate="50" count="0"/>
    <exit process="publish" when="shutdown" code="any"/>
    <message topic="/numbers" type="std_msgs/msg/String" max="2"/>
  </test>
  <test name="nothing else to wait for">
    <publish topic="/numbers" type="std_msgs/msg/Int64" values="{data: 7}" rate="50" count="0"/>
    <exit process="publish" when="shutdown" code="any"/>
    <message topic="/numbers" type="std_msgs/msg/Int64" where="data == 8" absent="true"/>
  </test>
  <test name="nobody may">
    <executable cmd="true" name="p"/><exit process="p"/>
    <message topic="/nowhere" type="std_msgs/msg/Int64" absent="true" without_publisher="true"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("a.launch.xml:5:6: error: a message on '/nowhere' could not come\n"));
  EXPECT_THAT(result.out, HasSubstr("      = expected: never a message on '/nowhere'\n"
                                    "      = seen: no publisher of the topic was found\n"
                                    "      = help: without_publisher=\"true\" allows that nobody publishes\n"));
  EXPECT_THAT(result.out, HasSubstr("a message on '/numbers' could not come\n"));
  EXPECT_THAT(result.out, HasSubstr("      = seen: the topic has messages of type std_msgs/msg/Int64, and not "
                                    "std_msgs/msg/String\n"));
  EXPECT_THAT(result.out, HasSubstr("a.launch.xml: nobody may "));
  EXPECT_THAT(result.out, HasSubstr("4 tests: 2 passed, 2 failed"));
}

TEST_F(ExpectedMessages, MessagesThatDoNotComeFailWithTheReason) {
  const CommandResult result = run_file(std::string(kPublisher) + R"xml(
    <message topic="/numbers" type="std_msgs/msg/String" within="3"/>
  </test>
  <test name="nobody"><executable cmd="sleep 100"/>
    <message topic="/nowhere" type="std_msgs/msg/Int64" where="data > 3" within="0.5"/>
  </test>
  <test name="slow">
    <publish topic="/numbers" type="std_msgs/msg/Int64" rate="5" count="0"/>
    <exit process="publish" when="shutdown" code="any"/>
    <message topic="/numbers" type="std_msgs/msg/Int64" min="3" min_rate="100"/>
  </test>)xml");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("a.launch.xml:9:6: error: there was not a message on '/nowhere' with data > 3 "
                                    "within 0.5 s\n"));
  EXPECT_THAT(result.out, HasSubstr("      = seen: no publisher of the topic was found\n"));
  EXPECT_THAT(result.out, HasSubstr("      = seen: the topic has messages of type std_msgs/msg/Int64, and not "
                                    "std_msgs/msg/String\n"));
  EXPECT_THAT(result.out, HasSubstr("error: a message on '/numbers' does not come at the rate that is expected\n"));
  EXPECT_THAT(result.out, HasSubstr("      = expected: at least 100 in a second\n"));
}

// Both sides read what the other one writes: Humble has longer identities of endpoints.
TEST_F(ExpectedMessages, NodesThatAnnounceThemselvesAsHumbleDoesAreSeen) {
  const CommandResult result = run({write("a.launch.xml", R"xml(
  <node pkg="demo_nodes" exec="pong"><env name="ROS_DISTRO" value="humble"/></node>
  <node pkg="demo_nodes" exec="ping"><param name="count" value="0"/></node>
  <test name="t" timeout="30">
    <graph node="/pong"/>
    <graph node="/ping"/>
    <graph service="/pong/list_parameters"/>
    <message topic="/pong" type="std_msgs/msg/Int64" min="3"/>
  </test>)xml")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

}  // namespace
