// SPDX-License-Identifier: Apache-2.0
// Faults of messages in the tests of launch files: real nodes lose messages, get them twice, late and changed.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/testing/launch_test_fixture.hpp"

namespace {

using namespace test_support;
using testing::AllOf;
using testing::HasSubstr;

// ping sends a number until it is answered, and ends after `count` answers.
constexpr const char* kNodes = R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping"><param name="count" value="5"/><param name="period_ms" value="10"/></node>)xml";

// One of each kind.
constexpr const char* kFourFaults = R"xml(
  <test name="t">
    <fault topic="/ping" do="drop" occurrence="2" count="2"/>
    <fault topic="/ping" do="duplicate" occurrence="5" process="ping"/>
    <fault topic="/pong" do="corrupt" occurrence="2" on="take" node="/ping"/>
    <fault topic="/pong" do="delay" occurrence="3" by="0.05"/>
    <exit process="ping"/>
  </test>)xml";

class MessageFaultTest : public LaunchTestFixture {
 protected:
  std::string write(const std::string& actions) { return LaunchTestFixture::write("a.launch.xml", actions); }

  nlohmann::json run_for_json(const std::string& file, std::vector<std::string> options = {}) {
    const std::string json = sandbox_.directory() / "result.json";
    options.insert(options.begin(), {file, "--json", json});
    result_ = run(std::move(options));
    return nlohmann::json::parse(read_file(json));
  }

  CommandResult result_;
};

TEST_F(MessageFaultTest, EachKindHitsItsMessages) {
  const std::string file = write(std::string(kNodes) + kFourFaults);
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  EXPECT_EQ(plain(result_.out), "PASS  a.launch.xml: t  T s  (4 of 4 faults)\n\n1 test: 1 passed, in T s\n");
  const auto& faults = results["tests"][0]["faults"];
  EXPECT_EQ(faults[0]["what"], "drop of messages 2 to 3 on '/ping'");
  EXPECT_EQ(faults[0]["messages"], 2);
  EXPECT_GT(faults[0]["latest_seconds"].get<double>(), faults[0]["seconds"].get<double>());
  EXPECT_EQ(faults[1]["what"], "duplicate of message 5 on '/ping' from 'ping'");
  EXPECT_EQ(faults[2]["what"], "corruption of message 2 on '/pong' when taken by '/ping'");
  EXPECT_EQ(faults[3]["what"], "delay by 0.05 s of message 3 on '/pong'");
}

// A node of another ROS 2 does not know of faults. A library between its rcl and rmw applies them; here it stands
// before the rmw of this stack, which sees no faults.
TEST_F(MessageFaultTest, NodesOfAnotherRos2GetALibraryThatAppliesThem) {
  const std::filesystem::path script = sandbox_.directory() / "their_node";
  write_file(script,
             "RMW_FAULT_LAYER=$RMW_MESSAGE_FAULTS\nexport RMW_FAULT_LAYER\nunset RMW_MESSAGE_FAULTS\nexec \"$@\"\n");
  const std::string prefix = "launch-prefix=\"sh " + script.string() + "\"";
  const std::string file = write(
      R"xml(
  <node pkg="demo_nodes" exec="pong" name="pong" )xml" +
      prefix + R"xml(/>
  <node pkg="demo_nodes" exec="ping" name="ping" )xml" +
      prefix + R"xml(><param name="count" value="5"/><param name="period_ms" value="10"/></node>)xml" + kFourFaults);
  const auto results = run_for_json(file);
  EXPECT_EQ(result_.exit_code, 0) << result_.out << result_.err;
  EXPECT_EQ(plain(result_.out), "PASS  a.launch.xml: t  T s  (4 of 4 faults)\n\n1 test: 1 passed, in T s\n");
  EXPECT_EQ(results["tests"][0]["faults"][0]["messages"], 2);
}

TEST_F(MessageFaultTest, AProcessThatIsStartedAgainPreloadsTheLibraryOnce) {
  const CommandResult result = run({write(std::string(kNodes) + R"xml(
  <executable name="shown" shell="true" respawn="true" respawn_delay="0.05" cmd="echo [$LD_PRELOAD]"/>
  <test name="t">
    <fault topic="/ping" do="drop" occurrence="2"/>
    <exit process="ping"/>
    <output process="shown" text="librmw_fault_layer.so" min="3"/>
    <output process="shown" pattern="librmw_fault_layer.*librmw_fault_layer" absent="true"/>
  </test>)xml")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

// What the trace says: ping has published, and pong has not taken.
TEST_F(MessageFaultTest, ADroppedMessageIsLostInTheTraceAndADelayedOneIsOld) {
  // The late message must come before ping ends. No other message may be as late, even on a busy machine.
  const std::string nodes = std::regex_replace(kNodes, std::regex("value=\"5\""), "value=\"150\"");
  const std::string file = write(nodes + R"xml(
  <test name="lost">
    <fault topic="/ping" do="drop" count="2">
      <depends_on process="ping" condition="output" pattern="ping 3 answered"/>
    </fault>
    <exit process="ping"/>
    <delivery topic="/ping" from="/ping" to="/pong" max_lost="0"/>
  </test>
  <test name="late">
    <fault topic="/ping" do="delay" by="1" occurrence="2"/>
    <exit process="ping"/>
    <latency topic="/ping" max_ms="999"/>
  </test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(plain(result.out), AllOf(HasSubstr("FAIL  a.launch.xml: lost"), HasSubstr("FAIL  a.launch.xml: late")));
  EXPECT_THAT(result.out, HasSubstr("error: messages of '/ping' were lost"));
  EXPECT_THAT(result.out, HasSubstr("error: messages of '/ping' do not take the time that is expected"));
  EXPECT_THAT(result.out, HasSubstr("seen: 1 of "));
}

TEST_F(MessageFaultTest, AMessageThatNeverComesFailsTheTestUnlessItIsDrawn) {
  const std::string file = write(std::string(kNodes) + R"xml(
  <test name="certain">
    <fault topic="/ping" do="drop" occurrence="1000"/>
    <fault topic="/pnig" do="drop"/>
    <fault topic="/pong" do="duplicate" occurrence="2" every="2" count="500"/>
    <exit process="pong" when="shutdown" code="any"/>
    <exit process="ping"/>
  </test>
  <test name="drawn">
    <fault topic="/ping" do="drop" occurrence="1000..1001"/>
    <exit process="ping"/>
  </test>)xml");
  const std::string leader = read_file(file);
  write_file(file, std::regex_replace(leader, std::regex("exec=\"ping\">"), "exec=\"ping\" on_exit=\"shutdown\">"));
  const auto results = run_for_json(file, {"-j", "1"});
  EXPECT_EQ(result_.exit_code, 1);
  const std::string out =
      std::regex_replace(plain(result_.out), std::regex("(there were|applied to) [0-9]+ "), "$1 N ");
  EXPECT_THAT(
      out,
      HasSubstr(
          R"(a.launch.xml:6:6: error: the drop of message 1000 on '/ping' was not applied: there were N messages on '/ping'
    6 |     <fault topic="/ping" do="drop" occurrence="1000"/>
      |      ^~~~~
)"));
  EXPECT_THAT(
      out,
      HasSubstr(
          R"(a.launch.xml:7:6: error: the drop of message 1 on '/pnig' was not applied: there were no messages on '/pnig'
)"));
  EXPECT_THAT(
      out,
      HasSubstr(
          R"(a.launch.xml:8:6: error: the duplicate of 500 messages on '/pong', 1 of 2 from message 2 on was applied to N of 500 messages only
)"));
  EXPECT_THAT(out, HasSubstr("PASS  a.launch.xml: drawn  T s  (0 of 1 fault)\n"));
}

// A test that waits for nothing but a message ends at its timeout, and says how many messages there were.
TEST_F(MessageFaultTest, TheTimeoutEndsTheWaitForAMessage) {
  const std::string file = write(R"xml(
  <executable name="p" cmd="cat"/>
  <test name="certain" timeout="0.5">
    <fault topic="/a" do="drop"/><exit process="p" when="shutdown" code="SIGINT"/>
  </test>
  <test name="drawn" timeout="0.5">
    <fault topic="/a" do="drop" occurrence="1..2"/><exit process="p" when="shutdown" code="SIGINT"/>
  </test>)xml");
  const CommandResult result = run({file, "-j", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.out), R"(FAIL  a.launch.xml: certain  T s  (0 of 1 fault)
a.launch.xml:5:6: error: the drop of message 1 on '/a' was not applied: there were no messages on '/a'
    5 |     <fault topic="/a" do="drop"/><exit process="p" when="shutdown" code="SIGINT"/>
      |      ^~~~~
      = seed 1: 0 of 1 fault applied
          1  a.launch.xml:5:6: drop of message 1 on '/a': not applied: there were no messages on '/a'
      = again: launch test a.launch.xml --name certain --seed 1
      = files: DIR/0001-certain
PASS  a.launch.xml: drawn  T s  (0 of 1 fault)

2 tests: 1 passed, 1 failed, in T s
FAIL  a.launch.xml: certain
)");
}

TEST_F(MessageFaultTest, CountsFromACondition) {
  // ping must still be there when the launch has seen the condition, even on a busy machine.
  const std::string nodes = std::regex_replace(kNodes, std::regex("value=\"5\""), "value=\"150\"");
  const std::string file = write(nodes + R"xml(
  <test name="t">
    <fault topic="/ping" do="drop">
      <depends_on process="ping" condition="output" pattern="ping 3 answered"/>
    </fault>
    <exit process="ping"/>
  </test>)xml");
  const CommandResult result = run({file, "--keep", "--directory", sandbox_.directory() / "out"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string output = read_file(sandbox_.directory() / "out/0001-t/output.txt");
  const std::size_t answer = output.find("ping 3 answered");
  const std::size_t fault = output.find("fault 1: drop of message 1 on '/ping'");
  ASSERT_NE(fault, std::string::npos) << output;
  EXPECT_LT(answer, fault);
}

TEST_F(MessageFaultTest, AFailureIsShrunkToTheOneFaultThatCausesIt) {
  const std::string file = write(R"xml(
  <node pkg="demo_nodes" exec="pong"/>
  <test name="answered" timeout="40">
    <fault topic="/ping" do="duplicate" occurrence="1..3"/>
    <fault name="all" topic="/ping" do="drop" count="all" probability="0.3"/>
    <fault topic="/ping" do="delay" by="0.01" occurrence="2"/>
    <receive name="answer" topic="/pong" type="std_msgs/msg/Int64"/>
    <publish topic="/ping" type="std_msgs/msg/Int64" values="{data: 7}" count="0" rate="20"/>
    <exit process="answer" within="8"/>
  </test>)xml");
  const auto results = run_for_json(file, {"--seed", "6", "--shrink"});
  EXPECT_EQ(result_.exit_code, 1) << result_.out;
  ASSERT_EQ(results["tests"].size(), 1U);
  const auto& test = results["tests"][0];
  EXPECT_EQ(test["outcome"], "failed") << test.dump(2);
  EXPECT_FALSE(test["faults"][1]["left_out"].get<bool>()) << "seed 6 draws it";
  ASSERT_TRUE(test.contains("shrunk")) << test.dump(2);
  ASSERT_EQ(test["shrunk"]["faults"].size(), 1U) << test.dump(2);
  EXPECT_EQ(test["shrunk"]["faults"][0]["what"], "drop of all messages on '/ping'");
}

TEST_F(MessageFaultTest, NamesThatNoProcessHasAreErrorsBeforeAnythingStarts) {
  const std::string file = write(R"xml(
  <executable name="worker" cmd="true"/>
  <test name="t"><fault topic="/a" process="wroker" do="drop"/><exit process="worker"/></test>)xml");
  const CommandResult result = run({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(plain(result.err), R"(a.launch.xml:4:45: error: no process is named 'wroker'
    4 |   <test name="t"><fault topic="/a" process="wroker" do="drop"/><exit process="worker"/></test>
      |                                             ^~~~~~
      = help: did you mean 'worker'?
)");
}

}  // namespace
