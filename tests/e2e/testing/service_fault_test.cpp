// SPDX-License-Identifier: Apache-2.0
// Faults of services in the tests of launch files: requests and responses of real nodes are lost, come twice and late.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

constexpr const char* kServer = R"xml(
  <node pkg="demo_nodes" exec="add_two_ints_server"/>)xml";
// Asks five times, each time after the answer before.
constexpr const char* kClient = R"xml(
  <node pkg="demo_nodes" exec="add_two_ints_client"><param name="count" value="5"/></node>)xml";

class ServiceFaultTest : public LaunchTestFixture {
 protected:
  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }

  nlohmann::json run_for_json(const std::string& file) {
    const std::string json = sandbox_.directory() / "result.json";
    result_ = run({file, "--json", json, "-j", "1"});
    return nlohmann::json::parse(read_file(json));
  }

  CommandResult result_;
};

TEST_F(ServiceFaultTest, EachKindHitsItsRequestsAndResponses) {
  const std::string file = write(std::string(kServer) + kClient + R"xml(
  <test name="t">
    <fault service="/add_two_ints" do="duplicate" occurrence="2"/>
    <fault service="/add_two_ints" do="duplicate" on="response" count="2" occurrence="3" process="add_two_ints_server"/>
    <fault service="/add_two_ints" do="delay" on="response" by="0.1" occurrence="5" node="/add_two_ints_server"/>
    <output process="add_two_ints_server" text="2 + 3 = 5" min="6" max="6"/>
    <output process="add_two_ints_client" text="2 + 3 = 5" min="5" max="5"/>
    <exit process="add_two_ints_client"/>
  </test>)xml");
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  EXPECT_EQ(plain(result_.out), "PASS  a.launch.xml: t  T s  (3 of 3 faults)\n\n1 test: 1 passed, in T s\n");
  const auto& faults = results["tests"][0]["faults"];
  EXPECT_EQ(faults[0]["what"], "duplicate of request 2 of '/add_two_ints'");
  EXPECT_EQ(faults[0]["messages"], 1);
  EXPECT_EQ(faults[1]["what"], "duplicate of responses 3 to 4 of '/add_two_ints' at 'add_two_ints_server'");
  EXPECT_EQ(faults[1]["messages"], 2);
  EXPECT_EQ(faults[2]["what"], "delay by 0.1 s of response 5 of '/add_two_ints' at '/add_two_ints_server'");
}

// What the trace says: the client has sent, and the service has not taken; or the service has answered, in vain.
TEST_F(ServiceFaultTest, WhatIsDroppedIsLostInTheTrace) {
  const std::string call = R"xml(
    <call name="lost" service="/add_two_ints" type="example_interfaces/srv/AddTwoInts" values="{a: 7}"/>
    <output process="lost" text="sum=" absent="true"/>
    <exit process="lost" when="shutdown" code="any"/>
    <event name="ros2:rmw_send_request" process="lost" min="1" max="1"/>)xml";
  const std::string file = write(std::string(kServer) + R"xml(
  <test name="a request" duration="1">
    <fault service="/add_two_ints" do="drop"/>)xml" +
                                 call + R"xml(
    <event name="ros2:rmw_take_request" where="taken == 1" process="add_two_ints_server" max="0" min="0"/>
  </test>
  <test name="a response" duration="1">
    <fault service="/add_two_ints" do="drop" on="response"/>)xml" +
                                 call + R"xml(
    <event name="ros2:rmw_take_request" where="taken == 1" process="add_two_ints_server" min="1"/>
    <event name="ros2:rmw_send_response" process="add_two_ints_server" min="1" max="1"/>
    <event name="ros2:rmw_take_response" where="taken == 1" process="lost" min="0" max="0"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

TEST_F(ServiceFaultTest, TheServicesOfActionsAreServices) {
  const std::string file = write(R"xml(
  <node pkg="demo_nodes" exec="fibonacci_action_server"/>
  <test name="t">
    <fault service="/fibonacci/_action/send_goal" do="delay" by="0.2"/>
    <fault service="/fibonacci/_action/get_result" do="duplicate"/>
    <send_goal name="goal" action="/fibonacci" type="example_interfaces/action/Fibonacci" values="{order: 2}"/>
    <exit process="goal"/>
  </test>)xml");
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  const auto& faults = results["tests"][0]["faults"];
  EXPECT_EQ(faults[0]["what"], "delay by 0.2 s of request 1 of '/fibonacci/_action/send_goal'");
  EXPECT_GE(results["tests"][0]["seconds"].get<double>(), faults[0]["seconds"].get<double>() + 0.2);
}

TEST_F(ServiceFaultTest, ARequestThatNeverComesFailsTheTest) {
  const std::string file = write(std::string(kServer) + kClient + R"xml(
  <test name="certain" duration="0.1">
    <fault service="/add_two_ints" do="drop" occurrence="1000" for="3"/>
    <fault service="/add_two_int" do="drop" on="response" for="3"/>
    <exit process="add_two_ints_client"/>
  </test>)xml");
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 1);
  EXPECT_THAT(
      plain(result_.out),
      HasSubstr(
          R"(a.launch.xml:6:6: error: the drop of all requests of '/add_two_ints' from request 1000 on for 3 s was not applied: there were 5 requests of '/add_two_ints' in that time
    6 |     <fault service="/add_two_ints" do="drop" occurrence="1000" for="3"/>
      |      ^~~~~
)"));
  EXPECT_THAT(
      plain(result_.out),
      HasSubstr(
          R"(a.launch.xml:7:6: error: the drop of all responses of '/add_two_int' for 3 s was not applied: there were no responses of '/add_two_int' in that time
)"));
}

}  // namespace
