// SPDX-License-Identifier: Apache-2.0
// Faults of the network in the tests of launch files: real nodes are separated, and their packets lost or late.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"
#include "tests/support/sanitized.hpp"

namespace {

using namespace test_support;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// ping sends a number until it is answered, and ends after `count` answers.
std::string nodes(int count) {
  return R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping"><param name="count" value=")xml" +
         std::to_string(count) + R"xml("/><param name="period_ms" value="10"/></node>)xml";
}

class NetworkFaultTest : public LaunchTestFixture {
 protected:
  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }

  nlohmann::json run_for_json(const std::string& file) {
    const std::string json = sandbox_.directory() / "result.json";
    result_ = run({file, "--json", json});
    return nlohmann::json::parse(read_file(json));
  }

  CommandResult result_;
};

TEST_F(NetworkFaultTest, NodesReachEachOtherAndTheirClientsWithoutAFault) {
  // ping goes on until the end.
  const std::string file = write(nodes(0) + R"xml(
  <test name="t">
    <fault do="partition" group="ping" from="pong" probability="0"/>
    <graph node="/pong"/>
    <output process="ping" text="ping 5 answered"/>
    <receive name="heard" topic="/ping" type="std_msgs/msg/Int64"/>
    <exit process="heard"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(NetworkFaultTest, APartitionLetsNothingThroughWhileItLasts) {
  const std::string file = write(nodes(50) + R"xml(
  <test name="all the time" duration="2">
    <fault do="partition" group="ping" from="pong"/>
    <output process="ping" text="answered" absent="true"/>
    <exit process="ping" when="shutdown" code="any"/>
  </test>
  <test name="for a while">
    <fault do="partition" group="ping" for="0.5..0.6">
      <depends_on process="ping" condition="output" pattern="ping 5 answered"/>
    </fault>
    <exit process="ping"/>
  </test>)xml");
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  const auto& all_the_time = results["tests"][0]["faults"][0];
  EXPECT_EQ(all_the_time["what"], "partition of 'ping' from 'pong'");
  EXPECT_LT(all_the_time["seconds"], 0.1);  // before the processes start
  EXPECT_GT(all_the_time["packets"], 0);
  const auto& for_a_while = results["tests"][1]["faults"][0];
  EXPECT_THAT(for_a_while["what"].get<std::string>(), HasSubstr("partition of 'ping' from the others for 0."));
  EXPECT_GT(for_a_while["packets"], 10);
}

TEST_F(NetworkFaultTest, LosesAndDelaysPackets) {
  const std::string file = write(nodes(20) + R"xml(
  <test name="lossy">
    <fault do="lose" group="ping" share="0.1..0.2"/>
    <exit process="ping"/>
  </test>
  <test name="slow">
    <fault do="delay" group="ping" from="pong" by="0.05"/>
    <exit process="ping"/>
    <latency topic="/ping" min_ms="50"/>
  </test>)xml");
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  EXPECT_THAT(results["tests"][0]["faults"][0]["what"].get<std::string>(),
              AllOf(HasSubstr("loss of "), HasSubstr("% of the packets between 'ping' and the others")));
  EXPECT_EQ(results["tests"][1]["faults"][0]["what"], "delay by 0.05 s of the packets between 'ping' and 'pong'");
}

TEST_F(NetworkFaultTest, NoTestPassesWhereTheyAreNotPossible) {
  if (test_support::kThreadSanitized) {
    GTEST_SKIP() << test_support::kHasOneMoreThread;  // unshare(2) of a user namespace
  }
  ASSERT_EQ(::mount("/dev/null", "/dev/net/tun", nullptr, MS_BIND, nullptr), 0);
  const std::string file = write(nodes(5) + R"xml(
  <test name="t"><fault do="partition" group="ping" probability="0"/><exit process="ping"/></test>)xml");
  const CommandResult result = run({file});
  ASSERT_EQ(::umount("/dev/net/tun"), 0);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(
      plain(result.out),
      HasSubstr(
          R"(a.launch.xml:5:47: error: faults of the network are not possible here: make a network device with /dev/net/tun: Inappropriate ioctl for device
    5 |   <test name="t"><fault do="partition" group="ping" probability="0"/><exit process="ping"/></test>
      |                                               ^~~~
      = help: they need network namespaces and /dev/net/tun, as root or with user namespaces
)"));
}

TEST_F(NetworkFaultTest, NamesThatNoProcessHasAreErrorsBeforeAnythingStarts) {
  const std::string file = write(R"xml(
  <executable name="worker" cmd="true"/>
  <test name="t"><fault do="partition" group="worker wroker" from="other"/><exit process="worker"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.err), AllOf(HasSubstr("a.launch.xml:4:47: error: no process is named 'wroker'"),
                                       HasSubstr("error: no process is named 'other'")));
}

}  // namespace
