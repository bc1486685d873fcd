// SPDX-License-Identifier: Apache-2.0
// The newest options and verbs of launch topic, service, action, param and component, with nodes of the stack.
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "tests/e2e/nodes/graph_command_case.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace std::chrono_literals;
using namespace test_support;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

TEST(GraphOptions, RatesOfAllTopics) {
  Sandbox sandbox;
  RunningCommand talker(program_of_stack("demo_nodes/talker"));
  ask_until({"topic", "list"}, "/chatter");
  RunningCommand rate(launch_words({"topic", "hz", "--all"}));
  EXPECT_TRUE(rate.wait_for_output("Subscribed to [/chatter]", kPatience)) << rate.err();
  EXPECT_TRUE(rate.wait_for_output("min_delta", kPatience)) << rate.out();
  EXPECT_EQ(rate.end_gently().exit_code, 0);
  RunningCommand bandwidth(launch_words({"topic", "bw", "/chatter", "/rosout"}));
  EXPECT_TRUE(bandwidth.wait_for_output("/chatter   ", kPatience)) << bandwidth.err();
  EXPECT_THAT(bandwidth.out(), StartsWith("Subscribed to [/chatter]\nSubscribed to [/rosout]\n"));
  EXPECT_THAT(bandwidth.out(),
              ContainsRegex("\n +topic +bandwidth +window +mean +min +max *\n=+\n/chatter +[0-9]+ B/s "));
  EXPECT_EQ(bandwidth.end_gently().exit_code, 0);
  EXPECT_EQ(launch_command({"topic", "hz"}).err,
            "launch topic hz: error: no topic is given\n      = help: name topics, or use --all\n");
  EXPECT_EQ(launch_command({"topic", "bw", "--all", "/chatter"}).exit_code, 2);
  talker.end_gently();
}

TEST(GraphOptions, MessagesOfAFile) {
  Sandbox sandbox;
  const std::filesystem::path file = sandbox.directory() / "messages.yaml";
  write_file(file, "---\ndata: one\n---\n---\ndata: two\n");
  RunningCommand echo(launch_words({"topic", "echo", "/words", "std_msgs/msg/String"}));
  const CommandResult sent = launch_command(
      {"topic", "pub", "/words", "std_msgs/msg/String", "--yaml-file", file.string(), "-r", "20", "-w", "1"});
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_THAT(sent.out, HasSubstr("publishing #1: std_msgs.msg.String(data='one')\n\n"
                                  "publishing #2: std_msgs.msg.String(data='two')\n\n"));
  EXPECT_TRUE(echo.wait_for_output("data: two\n---\n", kPatience)) << echo.out();
  EXPECT_EQ(echo.end_gently().out, "data: one\n---\ndata: two\n---\n");
  write_file(file, "data: one\n---\ndato: two\n");
  EXPECT_EQ(launch_command({"topic", "pub", "/words", "std_msgs/msg/String", "--yaml-file", file.string()}).err,
            file.string() +
                ":3:1: error: std_msgs/msg/String has no field 'dato'\n    3 | dato: two\n      | ^~~~\n"
                "      = help: did you mean 'data'?\n");
  write_file(file, "---\n");
  EXPECT_EQ(launch_command({"topic", "pub", "/words", "std_msgs/msg/String", "--yaml-file", file.string()}).err,
            "launch topic pub: error: '" + file.string() + "' holds no message\n");
}

TEST(GraphOptions, ServicesInDetail) {
  Sandbox sandbox;
  RunningCommand service(program_of_stack("demo_nodes_cpp/introspection_service",
                                          {"--ros-args", "-p", "service_configure_introspection:=contents"}));
  const CommandResult info = ask_until({"service", "info", "-v", "/add_two_ints"}, "Node name: introspection_service");
  EXPECT_THAT(
      info.out,
      MatchesRegex("Type: example_interfaces/srv/AddTwoInts\nClients count: 0\n\nServices count: 1\n\n"
                   "Node name: introspection_service\nNode namespace: /\n"
                   "Service type: example_interfaces/srv/AddTwoInts\n"
                   "Service type hash: RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a\n"
                   "Endpoint type: SERVER\nEndpoint count: 2\n"
                   "GIDs:\n- Request Reader : [0-9a-f.]+\n- Response Writer : [0-9a-f.]+\n"
                   "QoS profiles:\n- Request Reader :\n      Reliability: RELIABLE\n"
                   "      History \\(Depth\\): [^\n]*\n      Durability: VOLATILE\n(.|\n)*"
                   "- Response Writer :\n      Reliability: RELIABLE\n(.|\n)*\n\n"));
  RunningCommand echo(launch_words({"service", "echo", "/add_two_ints", "--flow-style"}));
  RunningCommand call(
      launch_words({"service", "call", "/add_two_ints", "example_interfaces/srv/AddTwoInts", "{a: 1, b: 2}", "--rate",
                    "5", "--qos-depth", "3", "--qos-reliability", "reliable"}));
  EXPECT_TRUE(call.wait_for_output("AddTwoInts_Response(sum=3)", kPatience)) << call.err();
  EXPECT_TRUE(echo.wait_for_output("event_type: RESPONSE_SENT", kPatience)) << echo.err();
  EXPECT_THAT(echo.out(), HasSubstr("event_type: REQUEST_RECEIVED"));
  EXPECT_THAT(echo.out(), HasSubstr("request: [{a: 1, b: 2}], response: []}\n---\n"));
  EXPECT_EQ(echo.end_gently().exit_code, 0);
  call.end_gently();
  service.end_gently();
}

TEST(GraphOptions, ActionsAreFoundAndEchoed) {
  Sandbox sandbox;
  RunningCommand server(program_of_stack("demo_nodes/fibonacci_action_server", {"--ros-args", "-p", "period_ms:=20"}));
  const std::string action = ask_until({"action", "find", "example_interfaces/action/Fibonacci"}, "fibonacci").out;
  EXPECT_EQ(action, "/fibonacci\n");
  EXPECT_EQ(ask_until({"action", "find", "-c", "example_interfaces/Fibonacci"}, "1").out, "1\n");
  RunningCommand echo(launch_words({"action", "echo", "/fibonacci", "-i", "feedback_topic | STATUS_TOPIC"}));
  const CommandResult goal = launch_command(
      {"action", "send_goal", "/fibonacci", "example_interfaces/action/Fibonacci", "{order: 30}", "--timeout", "60"});
  EXPECT_EQ(goal.exit_code, 0) << goal.err;
  EXPECT_TRUE(echo.wait_for_output("interface: STATUS_TOPIC\nstatus_list:\n", kPatience)) << echo.out() << echo.err();
  EXPECT_EQ(echo.end_gently().exit_code, 0);
  EXPECT_EQ(
      launch_command({"action", "echo", "/fibonacci", "-i", "GOALS"}).err,
      "launch action echo: error: an action has no interface 'GOALS'\n      = help: its interfaces are GOAL_SERVICE, "
      "CANCEL_SERVICE, RESULT_SERVICE, FEEDBACK_TOPIC, STATUS_TOPIC\n");
  server.end_gently();
}

TEST(GraphOptions, ParametersAreSetAtomically) {
  Sandbox sandbox;
  RunningCommand server(program_of_stack("demo_nodes/add_two_ints_server"));
  ask_until({"param", "list"}, "  count");
  const std::vector<std::string> set = {
      "param", "set", "/add_two_ints_server", "--atomic", "--service-timeout", "60", "--timeout", "60"};
  const auto with = [&set](std::vector<std::string> words) {
    words.insert(words.begin(), set.begin(), set.end());
    return launch_command(words);
  };
  EXPECT_EQ(with({"count", "7", "use_sim_time", "false"}).out, "Set parameters atomically successful\n");
  const CommandResult refused = with({"count", "8", "use_sim_time", "text"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, StartsWith("Setting parameters atomically failed: "));
  EXPECT_EQ(launch_command({"param", "get", "--hide-type", "/add_two_ints_server", "count", "--timeout", "60"}).out,
            "7\n");
  server.end_gently();
}

TEST(GraphOptions, ANodeThatDoesNotAnswerIsNamed) {
  Sandbox sandbox;
  RunningCommand server(program_of_stack("demo_nodes/add_two_ints_server"));
  RunningCommand hanging(Command{{HANGING_NODE, "sleep"}});
  EXPECT_TRUE(hanging.wait_for_output("tick 5\n", kPatience)) << hanging.err();
  ask_until({"node", "list"}, "/add_two_ints_server");
  const CommandResult list = launch_command({"param", "list", "--timeout", "10"});
  EXPECT_EQ(list.exit_code, 1);
  EXPECT_THAT(list.out, StartsWith("/add_two_ints_server:\n  count\n"));
  EXPECT_EQ(list.err, "node '/hanging_node' is left out: service '/hanging_node/list_parameters' has not answered\n");
  hanging.send_signal(SIGKILL);
  server.end_gently();
}

TEST(GraphOptions, ParametersOfNoNode) {
  Sandbox sandbox;
  const CommandResult list = launch_command({"param", "list"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(list.out, "");
  EXPECT_EQ(list.err, "launch param list: there is no node with parameters\n");
}

// Nodes of another ROS 2 may be found only after more than a second.
TEST(GraphOptions, ThatANodeIsNotThereIsSaidAfterALongLook) {
  Sandbox sandbox;
  const auto begin = std::chrono::steady_clock::now();
  const CommandResult set = launch_command({"param", "set", "/nobody", "gain", "1"});
  EXPECT_EQ(set.err, "launch param set: error: there is no node '/nobody'\n");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST(GraphOptions, AComponentOfItsOwn) {
  Sandbox sandbox;
  RunningCommand standalone(
      launch_words({"component", "standalone", "composition", "composition::Talker", "-c", "box"}));
  EXPECT_TRUE(standalone.wait_for_output("into '/box' container node as '/talker'", kPatience)) << standalone.err();
  EXPECT_EQ(ask_until({"component", "list"}, "/talker").out, "/box\n  1  /talker\n");
  EXPECT_EQ(standalone.end_gently().exit_code, 0);
  const CommandResult unknown = launch_command({"component", "standalone", "composition", "composition::Nothing"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("launch component standalone: error: the component was not loaded: "));
}

TEST(GraphOptions, AComponentEndsWithItsCommand) {
  Sandbox sandbox;
  RunningCommand standalone(
      launch_words({"component", "standalone", "composition", "composition::Talker", "-c", "box"}));
  EXPECT_TRUE(standalone.wait_for_output("into '/box' container node", kPatience)) << standalone.err();
  pid_t container = -1;
  const std::string pid = std::to_string(standalone.pid());
  std::ifstream("/proc/" + pid + "/task/" + pid + "/children") >> container;
  ASSERT_GT(container, 0);
  const int process = static_cast<int>(::syscall(SYS_pidfd_open, container, 0));
  ASSERT_GE(process, 0);
  standalone.send_signal(SIGKILL);
  standalone.wait(kPatience);
  pollfd ended{process, POLLIN, 0};
  EXPECT_EQ(::poll(&ended, 1, std::chrono::milliseconds(kPatience).count()), 1);
  ::close(process);
}

}  // namespace
