// SPDX-License-Identifier: Apache-2.0
// The nodes of demo_nodes_cpp, started as by the launch files of other projects.
#include <gmock/gmock.h>
#include <signal.h>

#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::HasSubstr;
using testing::Not;

namespace {

Command node(const std::string& name, const std::vector<std::string>& arguments = {}) {
  Command command{{std::string(DEMO_NODES_CPP) + "/" + name}};
  command.argv.insert(command.argv.end(), arguments.begin(), arguments.end());
  return command;
}

// Checks that a signal ends it without an error.
void stop(RunningCommand& command) {
  command.send_signal(SIGINT);
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST(DemoNodesCpp, EveryListenerHearsTheTalker) {
  const test_support::Sandbox sandbox;
  RunningCommand listener(node("listener"));
  RunningCommand best_effort(node("listener_best_effort", {"--ros-args", "-r", "__node:=other"}));
  RunningCommand serialized(node("listener_serialized_message"));
  RunningCommand talker(node("talker"));
  EXPECT_TRUE(listener.wait_for_output("[listener]: I heard: [Hello World: ")) << listener.err();
  EXPECT_TRUE(best_effort.wait_for_output("[other]: I heard: [Hello World: ")) << best_effort.err();
  EXPECT_TRUE(serialized.wait_for_output("serialized data after deserialization: Hello World: ")) << serialized.out();
  EXPECT_TRUE(talker.wait_for_output("[talker]: Publishing: 'Hello World: ")) << talker.err();
  for (RunningCommand* command : {&listener, &best_effort, &serialized, &talker}) {
    stop(*command);
  }
}

TEST(DemoNodesCpp, ListenerHearsLoanedMessages) {
  const test_support::Sandbox sandbox;
  RunningCommand listener(node("listener"));
  RunningCommand talker(node("talker_loaned_message"));
  EXPECT_TRUE(listener.wait_for_output("I heard: [Hello World: ")) << listener.err();
  EXPECT_TRUE(talker.wait_for_output("Publishing: '1.000000'")) << talker.err();
  stop(listener);
  stop(talker);
}

TEST(DemoNodesCpp, ListenerHearsSerializedMessages) {
  const test_support::Sandbox sandbox;
  RunningCommand listener(node("listener"));
  RunningCommand talker(node("talker_serialized_message"));
  EXPECT_TRUE(listener.wait_for_output("I heard: [Hello World:")) << listener.err();
  // The header stands for little endian; then come the length and the text.
  EXPECT_TRUE(talker.wait_for_output("serialized message:\n00 01 00 00 0e 00 00 00 48 65 6c 6c 6f")) << talker.out();
  stop(listener);
  stop(talker);
}

TEST(DemoNodesCpp, SubscriberGetsDangerousTemperaturesOnly) {
  const test_support::Sandbox sandbox;
  RunningCommand subscriber(node("content_filtering_subscriber"));
  RunningCommand publisher(node("content_filtering_publisher", {"--ros-args", "-p", "publish_ms:=5"}));
  EXPECT_TRUE(subscriber.wait_for_output("I receive an emergency temperature data: [110.000000]")) << subscriber.err();
  stop(publisher);
  subscriber.send_signal(SIGINT);
  EXPECT_THAT(subscriber.wait().err, Not(HasSubstr("I receive a temperature")));
}

TEST(DemoNodesCpp, ServerAnswersBothClients) {
  const test_support::Sandbox sandbox;
  RunningCommand server(node("add_two_ints_server"));
  const CommandResult client = run_command(node("add_two_ints_client"));
  EXPECT_EQ(client.exit_code, 0) << client.err;
  EXPECT_THAT(client.err, HasSubstr("[add_two_ints_client]: Result of add_two_ints: 5\n"));
  const CommandResult async_client = run_command(node("add_two_ints_client_async"));
  EXPECT_EQ(async_client.exit_code, 0) << async_client.err;
  EXPECT_THAT(async_client.err, HasSubstr("[add_two_ints_client]: Got result: [5]\n"));
  EXPECT_TRUE(server.wait_for_output("Incoming request\na: 2 b: 3")) << server.err();
  stop(server);
}

TEST(DemoNodesCpp, NodesLookAtTheirOwnParameters) {
  const test_support::Sandbox sandbox;
  const CommandResult list = run_command(node("list_parameters"));
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(list.err, HasSubstr("\nParameter names:\n bar\n foo\n foo.first\n foo.second\n"
                                  "Parameter prefixes:\n foo\n"));
  const CommandResult set = run_command(node("set_and_get_parameters"));
  EXPECT_EQ(set.exit_code, 0) << set.err;
  EXPECT_THAT(set.err, HasSubstr("\nParameter name: foo\nParameter value (integer): 2\n"
                                 "Parameter name: baz\nParameter value (double): 1.450000\n"));
  for (const char* name : {"parameter_events", "parameter_events_async"}) {
    const CommandResult events = run_command(node(name));
    EXPECT_EQ(events.exit_code, 0) << events.err;
    EXPECT_THAT(events.err, HasSubstr("Parameter event:\n new parameters:\n changed parameters:\n  bar\n"
                                      " deleted parameters:\n"))
        << name;
  }
}

TEST(DemoNodesCpp, BlackboardServesTheParametersThatItIsGiven) {
  const test_support::Sandbox sandbox;
  RunningCommand blackboard(node("parameter_blackboard", {"--ros-args", "-p", "colour:=red", "-r", "__ns:=/here"}));
  EXPECT_TRUE(
      blackboard.wait_for_output("Parameter blackboard node named '/here/parameter_blackboard' ready, and "
                                 "serving '"))
      << blackboard.err();
  // It may not spin yet, and an executor refuses a context that is shut down. So any end is accepted.
  blackboard.send_signal(SIGINT);
  blackboard.wait();
}

TEST(DemoNodesCpp, TimersStartOneAnother) {
  const test_support::Sandbox sandbox;
  RunningCommand one_off(node("one_off_timer"));
  RunningCommand reuse(node("reuse_timer"));
  EXPECT_TRUE(one_off.wait_for_output("in one_off_timer callback")) << one_off.err();
  EXPECT_TRUE(reuse.wait_for_output("in one_off_timer callback")) << reuse.err();
  stop(one_off);
  stop(reuse);
}

TEST(DemoNodesCpp, MatchesAreTold) {
  const test_support::Sandbox sandbox;
  const CommandResult result = run_command(node("matched_event_detect"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* line :
       {"First subscription is connected.",
        "The changed number of connected subscription is 1 and current number of connected "
        "subscription is 2.",
        "The changed number of connected subscription is -1 and current number of connected "
        "subscription is 1.",
        "Last subscription is disconnected.", "First publisher is connected.", "Last publisher is disconnected."}) {
    EXPECT_THAT(result.err, HasSubstr(line));
  }
}

}  // namespace
