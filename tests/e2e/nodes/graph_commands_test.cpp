// SPDX-License-Identifier: Apache-2.0
// launch topic, interface and their like, with nodes of the stack.
#include <gmock/gmock.h>

#include <chrono>
#include <regex>

#include "tests/e2e/nodes/graph_command_case.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace std::chrono_literals;
using namespace test_support;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

Command node(const std::string& name) {
  return program_of_stack("demo_nodes/" + name);
}

TEST(TopicCommand, ListsDescribesAndPrintsTopics) {
  Sandbox sandbox;
  RunningCommand talker(node("talker"));
  EXPECT_THAT(ask_until({"topic", "list", "-t"}, "/chatter [").out, HasSubstr("/chatter [std_msgs/msg/String]\n"));
  EXPECT_THAT(ask_until({"topic", "info", "/chatter"}, "Publisher count: 1").out,
              "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n");
  const CommandResult verbose = ask_until({"topic", "info", "-v", "chatter"}, "Node name: talker");
  EXPECT_THAT(verbose.out, HasSubstr("Node name: talker\nNode namespace: /\nTopic type: std_msgs/msg/String\n"));
  EXPECT_THAT(verbose.out, HasSubstr("Endpoint type: PUBLISHER\n"));
  EXPECT_THAT(verbose.out, HasSubstr("  Reliability: RELIABLE\n"));
  const CommandResult echo = ask_until({"topic", "echo", "--once", "/chatter"}, "data:");
  EXPECT_EQ(echo.exit_code, 0) << echo.err;
  EXPECT_THAT(echo.out, MatchesRegex("data: [^\n]*\n---\n"));
  EXPECT_THAT(ask_until({"topic", "type", "/chatter"}, "String").out, "std_msgs/msg/String\n");
  EXPECT_THAT(ask_until({"topic", "find", "std_msgs/String"}, "chatter").out, "/chatter\n");
  EXPECT_THAT(ask_until({"complete", "topic", "echo", "/cha"}, "chatter").out, "/chatter\n");
  talker.end_gently();
}

TEST(LoglevelCommand, PrintsAndSetsTheLevelsOfNodes) {
  Sandbox sandbox;
  RunningCommand worker(Command{{LOGGER_SERVICE_WORKER}});
  EXPECT_EQ(ask_until({"loglevel", "/left/worker"}, "unset").out, "/left/worker: unset\n");
  EXPECT_EQ(worker.err().find("a detail"), std::string::npos);
  EXPECT_EQ(ask_until({"loglevel", "/left/worker", "debug"}, "debug").out, "/left/worker: debug\n");
  EXPECT_TRUE(worker.wait_for_output("[left.worker]: a detail", kPatience)) << worker.err();
  EXPECT_EQ(ask_until({"loglevel", "/left/*"}, "debug").out, "/left/worker: debug\n");
  EXPECT_EQ(ask_until({"loglevel", "wor*", "error"}, "worker: error").out, "/left/worker: error\n");
  EXPECT_EQ(ask_until({"complete", "loglevel", "/left/"}, "worker").out, "/left/worker\n");
  EXPECT_EQ(launch_command({"complete", "loglevel", "/left/worker", "f"}).out, "fatal\n");
  worker.end_gently();
}

TEST(LoglevelCommand, SaysWhyItCannot) {
  Sandbox sandbox;
  RunningCommand talker(node("talker"));
  ask_until({"node", "list"}, "/talker");
  const CommandResult refused = launch_command({"loglevel", "/talker", "debug"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(
      refused.err,
      "launch loglevel: error: the node '/talker' has no services for the levels of its loggers\n"
      "      = help: a program has them with rclcpp::NodeOptions().enable_logger_service(true); 'launch --log-level "
      "NODE:=LEVEL' sets a level at the start of any node\n");
  EXPECT_EQ(launch_command({"loglevel", "/talker", "debg"}).err,
            "launch loglevel: error: there is no level 'debg'\n      = help: did you mean 'debug'?\n");
  EXPECT_EQ(launch_command({"loglevel", "/nowhere/*"}).err, "launch loglevel: error: no node matches '/nowhere/*'\n");
  talker.end_gently();
}

TEST(TopicCommand, MeasuresRates) {
  Sandbox sandbox;
  RunningCommand talker(node("talker"));
  for (const std::string verb : {"hz", "bw"}) {
    RunningCommand measure(Command{{LAUNCH_PROGRAM, "topic", verb, "/chatter"}});
    EXPECT_TRUE(measure.wait_for_output(verb == "hz" ? "average rate: " : "/s from ", kPatience)) << measure.err();
    EXPECT_EQ(measure.end_gently().exit_code, 0);
  }
  talker.end_gently();
}

TEST(TopicCommand, PublishesWhatIsWrittenAsYaml) {
  Sandbox sandbox;
  RunningCommand echo(Command{{LAUNCH_PROGRAM, "topic", "echo", "/pose", "geometry_msgs/msg/PoseStamped", "--once",
                               "--filter", "pose.position.x > 1 and header.stamp.sec > 0"}});
  RunningCommand pub(Command{{LAUNCH_PROGRAM, "topic", "pub", "--rate", "20", "/pose", "geometry_msgs/PoseStamped",
                              "{header: auto, pose: {position: {x: 1.5}, orientation: {w: 1}}}"}});
  EXPECT_TRUE(
      pub.wait_for_output("publishing #3: geometry_msgs.msg.PoseStamped(header=std_msgs.msg.Header(stamp=", kPatience))
      << pub.out() << pub.err();
  const CommandResult result = echo.wait(kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("header:\n  stamp:\n    sec: "));
  EXPECT_THAT(result.out, HasSubstr("\n  frame_id: ''\npose:\n  position:\n    x: 1.5\n    y: 0.0\n    z: 0.0\n"
                                    "  orientation:\n    x: 0.0\n    y: 0.0\n    z: 0.0\n    w: 1.0\n---\n"));
  EXPECT_EQ(pub.end_gently().exit_code, 0);
}

TEST(TopicCommand, NodesHearWhatIsPublished) {
  Sandbox sandbox;
  RunningCommand listener(node("listener"));
  const CommandResult pub = launch_command({"topic", "pub", "-1", "chatter", "std_msgs/String", "data: by hand"});
  EXPECT_EQ(pub.exit_code, 0) << pub.err;
  EXPECT_TRUE(listener.wait_for_output("by hand", kPatience)) << listener.out() << listener.err();
  listener.end_gently();
}

TEST(TopicCommand, ShowsThePlaceOfAMistake) {
  Sandbox sandbox;
  CommandResult result = launch_command({"topic", "pub", "/x", "std_msgs/msg/String", "{dta: hi}"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "values:1:2: error: std_msgs/msg/String has no field 'dta'\n"
            "    1 | {dta: hi}\n"
            "      |  ^~~\n"
            "      = help: did you mean 'data'?\n");
  result = launch_command({"topic", "pub", "/x", "std_msgs/msg/Strin", "{}"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err,
            "launch topic pub: error: there is no interface 'std_msgs/msg/Strin'\n"
            "      = help: did you mean 'std_msgs/msg/String'?\n");
  result = launch_command({"topic", "eco", "/x"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "launch topic: error: unknown command 'eco'\n      = help: did you mean 'echo'?\n"
            "      = help: see 'launch topic --help'\n");
  EXPECT_EQ(launch_command({"topic", "ehco"}).err, launch_command({"topic", "ehco", "/x"}).err);
  EXPECT_THAT(launch_command({"topic", "ehco"}).err, HasSubstr("= help: did you mean 'echo'?\n"));
  EXPECT_THAT(launch_command({"service", "lst"}).err, HasSubstr("= help: did you mean 'list'?\n"));
  EXPECT_EQ(launch_command({"node", "--lsit"}).err,
            "launch node: error: unknown option '--lsit'\n      = help: see 'launch node --help'\n");
  result = launch_command({"topic", "echo", "/nothing"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "launch topic echo: error: unknown topic '/nothing'\n");
  EXPECT_EQ(launch_command({"topic", "echo", "a b"}).exit_code, 1);
  EXPECT_EQ(launch_command({"topic", "echo", "--onec", "/x"}).exit_code, 2);
}

TEST(NodeCommand, ListsAndDescribesNodes) {
  Sandbox sandbox;
  RunningCommand talker(node("talker"));
  EXPECT_EQ(ask_until({"node", "list"}, "/talker").out, "/talker\n");
  const CommandResult info = ask_until({"node", "info", "talker"}, "/chatter: std_msgs/msg/String");
  EXPECT_THAT(info.out, StartsWith("/talker\n  Subscribers:\n"));
  EXPECT_THAT(info.out, HasSubstr("  Publishers:\n    /chatter: std_msgs/msg/String\n"));
  EXPECT_THAT(info.out, HasSubstr("    /talker/get_parameters: rcl_interfaces/srv/GetParameters\n"));
  EXPECT_THAT(info.out, HasSubstr("  Action Clients:\n\n"));
  EXPECT_EQ(launch_command({"node", "info", "/talkr"}).err,
            "launch node info: error: there is no node '/talkr'\n      = help: did you mean '/talker'?\n");
  talker.end_gently();
}

TEST(ServiceCommand, CallsServices) {
  Sandbox sandbox;
  RunningCommand server(node("add_two_ints_server"));
  EXPECT_THAT(ask_until({"service", "list", "-t"}, "/add_two_ints").out,
              HasSubstr("/add_two_ints [example_interfaces/srv/AddTwoInts]\n"));
  const CommandResult call =
      launch_command({"service", "call", "add_two_ints", "example_interfaces/srv/AddTwoInts", "{a: 2, b: 40}"});
  EXPECT_EQ(call.exit_code, 0) << call.err;
  EXPECT_THAT(call.out, HasSubstr("requester: making request: example_interfaces.srv.AddTwoInts_Request(a=2, b=40)\n\n"
                                  "response:\nexample_interfaces.srv.AddTwoInts_Response(sum=42)\n\n"));
  EXPECT_EQ(ask_until({"service", "type", "/add_two_ints"}, "AddTwoInts").out, "example_interfaces/srv/AddTwoInts\n");
  EXPECT_EQ(ask_until({"service", "find", "example_interfaces/AddTwoInts"}, "/add").out, "/add_two_ints\n");
  EXPECT_THAT(ask_until({"service", "info", "/add_two_ints"}, "Services count: 1").out,
              HasSubstr("Type: example_interfaces/srv/AddTwoInts\n"));
  EXPECT_EQ(launch_command({"service", "call", "/x", "std_srvs/srv/Empty", "--timeout", "1"}).err,
            "launch service call: error: there is no service '/x'\n");
  EXPECT_EQ(launch_command({"service", "call", "/x", "example_interfaces/AddTwoInts", "{a: one}"}).err,
            "values:1:5: error: int64 is expected, found str 'one'\n"
            "    1 | {a: one}\n"
            "      |     ^~~\n");
  server.end_gently();
}

TEST(ParamCommand, ReadsAndWritesParameters) {
  Sandbox sandbox;
  RunningCommand server(node("add_two_ints_server"));
  EXPECT_THAT(ask_until({"param", "list"}, "  count").out, HasSubstr("/add_two_ints_server:\n  count\n"));
  const std::string name = "/add_two_ints_server";
  EXPECT_EQ(launch_command({"param", "get", name, "count", "--timeout", "60"}).out, "Integer value is: 0\n");
  EXPECT_EQ(launch_command({"param", "set", name, "count", "7", "--timeout", "60"}).out, "Set parameter successful\n");
  EXPECT_EQ(launch_command({"param", "get", "--hide-type", name, "count", "--timeout", "60"}).out, "7\n");
  const CommandResult refused = launch_command({"param", "set", name, "count", "text", "--timeout", "60"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, StartsWith("Setting parameter failed: "));
  EXPECT_EQ(launch_command({"param", "get", name, "cuont", "--timeout", "60"}).err,
            "launch param get: error: parameter 'cuont' of '/add_two_ints_server' is not set\n"
            "      = help: did you mean 'count'?\n");
  EXPECT_THAT(launch_command({"param", "describe", name, "count", "--timeout", "60"}).out,
              HasSubstr("Parameter name: count\n  Type: integer\n"));
  const CommandResult dump = launch_command({"param", "dump", name, "--timeout", "60"});
  EXPECT_THAT(dump.out, StartsWith("/add_two_ints_server:\n  ros__parameters:\n    count: 7\n"));
  const std::filesystem::path file = sandbox.directory() / "parameters.yaml";
  write_file(file, "/**:\n  ros__parameters:\n    count: 9\n");
  const CommandResult load = launch_command({"param", "load", name, file.string(), "--timeout", "60"});
  EXPECT_EQ(load.out, "Set parameter count successful\n") << load.err;
  EXPECT_EQ(launch_command({"param", "get", "--hide-type", name, "count", "--timeout", "60"}).out, "9\n");
  EXPECT_EQ(launch_command({"complete", "param", "get", name, "cou"}).out, "count\n");
  EXPECT_EQ(launch_command({"param", "set", name, "count", "5", "use_sim_time", "false", "--timeout", "60"}).out,
            "count: Set parameter successful\nuse_sim_time: Set parameter successful\n");
  const CommandResult several =
      launch_command({"param", "get", name, "count", "nix", "use_sim_time", "--timeout", "60"});
  EXPECT_EQ(several.out, "count:\n  Integer value is: 5\nuse_sim_time:\n  Boolean value is: False\n");
  EXPECT_EQ(several.err, "nix: parameter of '/add_two_ints_server' is not set\n");
  EXPECT_EQ(several.exit_code, 1);
  EXPECT_EQ(launch_command({"param", "set", name, "count", "5", "x", "--timeout", "60"}).err,
            "launch param set: error: parameter 'x' has no value\n      = help: names and values stand in turn\n");
  EXPECT_EQ(ask_until({"param", "get", "count"}, "Integer").out, "/add_two_ints_server:\n  Integer value is: 5\n");
  EXPECT_EQ(launch_command({"param", "get", name}).err,
            "launch param get: error: no parameter is given\n"
            "      = help: launch param get /add_two_ints_server PARAMETER\n");
  EXPECT_THAT(launch_command({"param", "list", name, "--timeout", "60"}).out, HasSubstr("  count\n"));
  server.end_gently();
}

TEST(ActionCommand, SendsGoals) {
  Sandbox sandbox;
  RunningCommand server(
      Command{{BUILD_DIRECTORY "/prefix/lib/demo_nodes/fibonacci_action_server", "--ros-args", "-p", "period_ms:=20"}});
  EXPECT_THAT(ask_until({"action", "list", "-t"}, "/fibonacci").out,
              "/fibonacci [example_interfaces/action/Fibonacci]\n");
  const CommandResult goal =
      launch_command({"action", "send_goal", "-f", "fibonacci", "example_interfaces/action/Fibonacci", "{order: 5}"});
  EXPECT_EQ(goal.exit_code, 0) << goal.err;
  EXPECT_THAT(goal.out, HasSubstr("Sending goal:\n     order: 5\n\nGoal accepted with ID: "));
  EXPECT_THAT(goal.out, HasSubstr("Result:\n    sequence:\n- 0\n- 1\n- 1\n- 2\n- 3\n- 5\n\n"
                                  "Goal finished with status: SUCCEEDED\n"));
  EXPECT_THAT(ask_until({"action", "info", "/fibonacci"}, "Action servers: 1").out,
              StartsWith("Action: /fibonacci\nAction clients: 0\nAction servers: 1\n    /"));
  RunningCommand canceled(Command{
      {LAUNCH_PROGRAM, "action", "send_goal", "/fibonacci", "example_interfaces/action/Fibonacci", "{order: 45}"}});
  EXPECT_TRUE(canceled.wait_for_output("Goal accepted", kPatience)) << canceled.err();
  canceled.send_signal(SIGINT);
  EXPECT_THAT(canceled.wait(kPatience).out, HasSubstr("Canceling goal...\nGoal canceled.\n"));
  server.end_gently();
}

TEST(LifecycleCommand, ShowsAndChangesStates) {
  Sandbox sandbox;
  RunningCommand talker(Command{{BUILD_DIRECTORY "/prefix/lib/lifecycle/lifecycle_talker"}});
  EXPECT_EQ(ask_until({"lifecycle", "nodes"}, "/lc_talker").out, "/lc_talker\n");
  EXPECT_EQ(launch_command({"lifecycle", "get", "lc_talker", "--spin-time", "60"}).out, "unconfigured [1]\n");
  EXPECT_THAT(launch_command({"lifecycle", "list", "/lc_talker", "--spin-time", "60"}).out,
              HasSubstr("- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"));
  EXPECT_EQ(launch_command({"lifecycle", "set", "/lc_talker", "configure", "--spin-time", "60"}).out,
            "Transitioning successful\n");
  EXPECT_EQ(launch_command({"lifecycle", "get", "/lc_talker", "--spin-time", "60"}).out, "inactive [2]\n");
  EXPECT_EQ(launch_command({"lifecycle", "set", "/lc_talker", "activat", "--spin-time", "60"}).err,
            "launch lifecycle set: error: '/lc_talker' has no transition 'activat' now\n"
            "      = help: did you mean 'activate'?\n");
  talker.end_gently();
}

TEST(ComponentCommand, LoadsAndUnloadsComponents) {
  Sandbox sandbox;
  EXPECT_THAT(launch_command({"component", "types"}).out, HasSubstr("composition\n  composition::Talker\n"));
  RunningCommand container(Command{{BUILD_DIRECTORY "/prefix/lib/rclcpp_components/component_container"}});
  EXPECT_EQ(ask_until({"component", "list"}, "/ComponentManager").out, "/ComponentManager\n");
  EXPECT_EQ(launch_command({"component", "load", "/ComponentManager", "composition", "composition::Talker", "-n",
                            "mine", "--spin-time", "60"})
                .out,
            "Loaded component 1 into '/ComponentManager' container node as '/mine'\n");
  EXPECT_EQ(ask_until({"component", "list", "/ComponentManager"}, "/mine").out, "1  /mine\n");
  EXPECT_EQ(launch_command({"component", "unload", "/ComponentManager", "1", "--spin-time", "60"}).out,
            "Unloaded component 1 from '/ComponentManager' container node\n");
  container.end_gently();
}

class StepsOfExamples : public testing::TestWithParam<const char*> {};

TEST_P(StepsOfExamples, OfTestsTakePartInTheGraph) {
  Sandbox sandbox;
  const CommandResult result = run_command(
      Command{{LAUNCH_PROGRAM, "test", "-j", "1", EXAMPLES_DIRECTORY "/44_steps.launch." + std::string(GetParam())}},
      4 * kPatience);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("\n3 tests: 3 passed, in "));
}

INSTANTIATE_TEST_SUITE_P(Formats, StepsOfExamples, testing::Values("xml", "yaml"));

TEST(Steps, ThatDoNotSucceedFailTheTest) {
  Sandbox sandbox;
  const std::filesystem::path file = sandbox.directory() / "refused.launch.xml";
  write_file(file, R"(<launch>
  <node pkg="demo_nodes" exec="add_two_ints_server"/>
  <test name="refused">
    <change_parameter node="add_two_ints_server" parameter="count" value="text"/>
    <exit process="change_parameter" code="0"/>
  </test>
</launch>
)");
  const CommandResult result = run_command(Command{{LAUNCH_PROGRAM, "test", file.string()}}, 2 * kPatience);
  EXPECT_EQ(result.exit_code, 1) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("Setting parameter failed: "));
}

TEST(InterfaceCommand, ShowsWhatIsInstalled) {
  Sandbox sandbox;
  EXPECT_EQ(launch_command({"interface", "show", "--no-comments", "std_msgs/msg/Header"}).out,
            "builtin_interfaces/Time stamp\n\tint32 sec\n\tuint32 nanosec\nstring frame_id\n");
  EXPECT_THAT(launch_command({"interface", "list", "-a"}).out, HasSubstr("    example_interfaces/action/Fibonacci\n"));
  EXPECT_EQ(launch_command({"interface", "package", "std_srvs"}).out,
            "std_srvs/srv/Empty\nstd_srvs/srv/SetBool\nstd_srvs/srv/Trigger\n");
  EXPECT_EQ(launch_command({"interface", "proto", "--no-quotes", "std_msgs/msg/Bool"}).out, "data: false\n\n");
  EXPECT_EQ(launch_command({"complete", "interface", "show", "std_srvs/srv/T"}).out, "std_srvs/srv/Trigger\n");
}

}  // namespace
