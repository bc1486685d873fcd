// SPDX-License-Identifier: Apache-2.0
// Simulated time in the tests of launch files: a clock, and what faults do to it.
#include <gmock/gmock.h>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

class ClockFaultTest : public LaunchTestFixture {
 protected:
  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }
};

TEST_F(ClockFaultTest, AClockRunsAtItsRate) {
  const std::string file = write(R"xml(
  <test name="t">
    <clock rate="10000" start="1000"/>
    <receive name="begin" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec >= 1000"/>
    <receive name="end" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec >= 11000"/>
    <exit process="begin"/><exit process="end" within="30"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(ClockFaultTest, JumpsSkewsAndStops) {
  const std::string file = write(R"xml(
  <test name="t">
    <clock name="time"/>
    <receive name="before" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec &lt; 1000"/>
    <fault clock="time" do="jump" by="5000"><depends_on process="before" condition="exited"/></fault>
    <receive name="jumped" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec >= 5000">
      <depends_on process="before" condition="exited"/>
    </receive>
    <fault clock="time" do="skew" rate="100000"><depends_on process="jumped" condition="exited"/></fault>
    <receive name="skewed" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec >= 50000">
      <depends_on process="jumped" condition="exited"/>
    </receive>
    <fault clock="time" do="jump" by="-100000000"><depends_on process="skewed" condition="exited"/></fault>
    <fault clock="time" do="stop"><depends_on process="skewed" condition="exited"/></fault>
    <receive name="at the begin" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec &lt; 5000">
      <depends_on process="skewed" condition="exited"/>
    </receive>
    <exit process="before"/><exit process="jumped"/><exit process="skewed"/><exit process="at the begin"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("(4 of 4 faults)"));
}

TEST_F(ClockFaultTest, AnotherProcessIsNoClock) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="cat"/>
  <test name="t" duration="0.2"><fault clock="p" do="stop"/><exit process="p" when="shutdown" code="SIGINT"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out),
              HasSubstr("a.launch.xml:4:34: error: the stop of clock 'p' was not applied: 'p' is no clock\n"));
}

TEST_F(ClockFaultTest, ACommandThatItDoesNotKnowIsTold) {
  const CommandResult result =
      run_command({.argv = {"timeout", "--signal=INT", "5", "sh", "-c",
                            "(echo slower; echo stop; sleep 1) | exec " LAUNCH_PROGRAM " clock"}},
                  std::chrono::seconds(60));
  EXPECT_THAT(result.out, HasSubstr("a clock knows stop, go, scale FACTOR and jump SECONDS, not 'slower'\n"));
}

}  // namespace
