// SPDX-License-Identifier: Apache-2.0
// The demo nodes as a user runs them.
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

namespace {

std::string node(const std::string& name) {
  return std::string(DEMO_NODES) + "/" + name;
}

TEST(DemoNodes, PingAndPongEndWhenTheyHaveExchangedTheirMessages) {
  const test_support::Sandbox sandbox;
  RunningCommand pong(Command{{node("pong"), "--ros-args", "-p", "count:=5"}});
  RunningCommand ping(Command{{node("ping"), "--ros-args", "-p", "count:=5", "-p", "period_ms:=20"}});
  const CommandResult ping_result = ping.wait();
  const CommandResult pong_result = pong.wait();
  EXPECT_EQ(ping_result.exit_code, 0) << ping_result.err;
  EXPECT_EQ(pong_result.exit_code, 0) << pong_result.err;
  for (const char* number : {"1", "2", "3", "4", "5"}) {
    EXPECT_THAT(ping_result.err, HasSubstr("[ping]: ping " + std::string(number) + " answered after "));
    EXPECT_THAT(pong_result.err, HasSubstr("[pong]: pong " + std::string(number) + "\n"));
  }
}

TEST(DemoNodes, ListenerHearsTalkerUnderOtherNames) {
  const test_support::Sandbox sandbox;
  const std::vector<std::string> names = {"--ros-args", "-r", "__ns:=/here", "-r", "chatter:=news"};
  Command talk{{node("talker")}};
  Command listen{{node("listener")}};
  talk.argv.insert(talk.argv.end(), names.begin(), names.end());
  listen.argv.insert(listen.argv.end(), names.begin(), names.end());
  RunningCommand listener(listen);
  RunningCommand talker(talk);
  EXPECT_TRUE(listener.wait_for_output("[here.listener]: I heard: [Hello World: ")) << listener.err();
  EXPECT_TRUE(talker.wait_for_output("[here.talker]: Publishing: 'Hello World: ")) << talker.err();
  listener.send_signal(SIGINT);
  talker.send_signal(SIGTERM);
  const CommandResult listener_result = listener.wait();
  EXPECT_EQ(listener_result.exit_code, 0) << listener_result.err;
  EXPECT_EQ(talker.wait().exit_code, 0);
}

TEST(DemoNodes, ServerAnswersClientUnderAnotherName) {
  const test_support::Sandbox sandbox;
  const std::vector<std::string> names = {"--ros-args", "-r", "add_two_ints:=sum", "-p", "count:=3"};
  Command serve{{node("add_two_ints_server")}};
  Command ask{{node("add_two_ints_client")}};
  serve.argv.insert(serve.argv.end(), names.begin(), names.end());
  ask.argv.insert(ask.argv.end(), names.begin(), names.end());
  ask.argv.insert(ask.argv.end(), {"-p", "a:=40"});
  RunningCommand server(serve);
  RunningCommand client(ask);
  const CommandResult client_result = client.wait();
  EXPECT_EQ(client_result.exit_code, 0) << client_result.err;
  EXPECT_THAT(client_result.err, HasSubstr("[add_two_ints_client]: 40 + 3 = 43\n"));
  const CommandResult server_result = server.wait();
  EXPECT_EQ(server_result.exit_code, 0) << server_result.err;
  EXPECT_THAT(server_result.err, HasSubstr("[add_two_ints_server]: 40 + 3 = 43\n"));
}

TEST(DemoNodes, WrongArgumentsEndWithAMessageAndExitCode1) {
  const test_support::Sandbox sandbox;
  for (const char* name : {"ping", "pong", "talker", "listener", "add_two_ints_server", "add_two_ints_client"}) {
    const CommandResult result = run_command({node(name), "--ros-args", "--what"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, std::string(name) + ": found unknown ROS arguments: '--what'\n");
  }
  const CommandResult result = run_command({node("ping"), "--ros-args", "-p", "count:=many"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "ping: parameter 'count' has invalid type: Wrong parameter type, parameter {count} is of type {integer}, "
            "setting it to {string} is not allowed.\n");
}

}  // namespace
