// SPDX-License-Identifier: Apache-2.0
// The containers and the programs of components, as a launch file starts them.
#include <gmock/gmock.h>
#include <signal.h>

#include <set>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp_components/container_client.hpp"

namespace {

using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::ElementsAre;
using testing::HasSubstr;

struct Container {
  std::string name;  // of the test
  std::string program;
  std::vector<std::string> options;
  bool isolated;
};

void PrintTo(const Container& container, std::ostream* stream) {
  *stream << container.name;
}

class ComponentContainer : public RosTest, public testing::WithParamInterface<Container> {
 protected:
  ComponentContainer() { executor_.add_node(node_); }

  Command container() const {
    Command command{{PREFIX "/lib/rclcpp_components/" + GetParam().program}};
    command.argv.insert(command.argv.end(), GetParam().options.begin(), GetParam().options.end());
    command.argv.insert(command.argv.end(), {"--ros-args", "-r", "__node:=box", "-r", "__ns:=/here"});
    return command;
  }

  rclcpp::executors::SingleThreadedExecutor executor_;
  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("asker");
  ContainerClient client_{executor_, node_, "/here/box"};
};

TEST_P(ComponentContainer, RunsComponentsAndEndsOnSigint) {
  RunningCommand box(container());
  EXPECT_TRUE(client_.load("composition", "composition::Talker").success);
  EXPECT_TRUE(client_.load("composition", "composition::Listener").success);
  EXPECT_TRUE(client_.load("composition", "composition::NodeLikeListener").success);
  EXPECT_TRUE(client_.load("composition", "composition::Server").success);
  EXPECT_TRUE(client_.load("composition", "composition::Client").success);
  EXPECT_TRUE(box.wait_for_output("[listener]: I heard: [Hello World: ")) << box.err();
  EXPECT_TRUE(box.wait_for_output("[node_like_listener]: I heard: [Hello World: ")) << box.err();
  EXPECT_TRUE(box.wait_for_output("[client]: Got result: [5]")) << box.err();
  EXPECT_THAT(client_.list().full_node_names,
              ElementsAre("/talker", "/listener", "/node_like_listener", "/server", "/client"));
  EXPECT_TRUE(client_.unload(2).success);
  box.send_signal(SIGINT);
  const CommandResult result = box.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("[here.box]: Load Library: " PREFIX "/lib/libtalker_component.so\n"));
  EXPECT_THAT(result.err,
              HasSubstr("[here.box]: Found class: rclcpp_components::NodeFactoryTemplate<composition::Talker>\n"));
  EXPECT_THAT(result.err, HasSubstr("[here.box]: Instantiate class: "
                                    "rclcpp_components::NodeFactoryTemplate<composition::Talker>\n"));
}

TEST_P(ComponentContainer, GivesComponentsThreadsOfTheirOwnOnlyIfIsolated) {
  const std::filesystem::path prefix = sandbox_.directory() / "prefix";
  write_components(prefix, "tested", "test_components::ThreadTeller;" TEST_COMPONENTS "\n");
  Command command = container();
  command.environment["AMENT_PREFIX_PATH"] = prefix.string();
  RunningCommand box(command);
  EXPECT_TRUE(client_.load("tested", "test_components::ThreadTeller", "one").success);
  EXPECT_TRUE(client_.load("tested", "test_components::ThreadTeller", "two_is_a_longer_name").success);

  std::set<std::string> threads;
  const auto subscription = node_->create_subscription<std_msgs::msg::String>(
      "thread", 10, [&](const std_msgs::msg::String& message) { threads.insert(message.data); });
  const auto publisher = node_->create_publisher<std_msgs::msg::String>("ask", 10);
  ASSERT_TRUE(spin_until(
      executor_, [&] { return publisher->get_subscription_count() == 2 && node_->count_publishers("thread") == 2; }));
  std::set<std::string> expected = {GetParam().program.substr(0, 15)};
  if (GetParam().isolated) {
    expected = {"one", "two_is_a_longer"};
  }
  // Asks again until both answers have arrived: the way back may be matched later than the way there.
  EXPECT_TRUE(spin_until(executor_, [&] {
    publisher->publish(std_msgs::msg::String());
    return threads == expected;
  })) << testing::PrintToString(threads);
  box.end_gently();
}

TEST_P(ComponentContainer, WrongArgumentsEndItWithAMessage) {
  const CommandResult result = run_command({PREFIX "/lib/rclcpp_components/" + GetParam().program, "--ros-args", "-x"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, GetParam().program + ": found unknown ROS arguments: '-x'\n");
}

struct WrongArguments {
  std::vector<std::string> words;
  std::string message;
};

TEST(ComponentContainerOptions, WrongOnesAreRefusedByName) {
  const test_support::Sandbox sandbox;
  const std::string types = " (one of single-threaded, multi-threaded, events, events-cbg)\n";
  for (const auto& [words, message] : std::initializer_list<WrongArguments>{
           {{"--isolate"}, "unknown argument '--isolate'; did you mean '--isolated'?\n"},
           {{"--executor_type=events"}, "unknown argument '--executor_type=events'; did you mean '--executor-type'?\n"},
           {{"--threads", "4"}, "unknown argument '--threads'; --help lists the options\n"},
           {{"--isolated", "loose"}, "unknown argument 'loose'; --help lists the options\n"},
           {{"--executor-type"}, "--executor-type needs a value" + types},
           {{"--executor-type", "nonsense"}, "unknown executor 'nonsense' in --executor-type" + types},
           {{"--executor-type=event-cbg"},
            "unknown executor 'event-cbg' in --executor-type; did you mean 'events-cbg'?" + types}}) {
    std::vector<std::string> argv = {PREFIX "/lib/rclcpp_components/component_container"};
    argv.insert(argv.end(), words.begin(), words.end());
    argv.insert(argv.end(), {"--ros-args", "-r", "__node:=box"});
    const CommandResult result = run_command(argv);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "component_container: " + message);
  }
}

TEST(ComponentContainerOptions, HelpNamesThem) {
  const test_support::Sandbox sandbox;
  const CommandResult result = run_command({PREFIX "/lib/rclcpp_components/component_container_mt", "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("usage: component_container_mt [--executor-type TYPE]"));
  EXPECT_THAT(result.out, HasSubstr("single-threaded, multi-threaded, events, events-cbg\n"));
}

TEST(ComponentContainerOptions, ThreadsThatHaveNoEffectAreAWarning) {
  const test_support::Sandbox sandbox;
  const std::string warning = "The parameter 'thread_num' has no effect";
  RunningCommand single(
      Command{{PREFIX "/lib/rclcpp_components/component_container", "--ros-args", "-p", "thread_num:=1"}});
  EXPECT_TRUE(single.wait_for_output(warning)) << single.err();
  single.end_gently();
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ComponentContainer,
    testing::Values(
        Container{"single", "component_container", {}, false},
        Container{"several", "component_container_mt", {}, false},
        Container{"events", "component_container_event", {}, false},
        Container{"events_cbg", "component_container_events_cbg", {}, false},
        Container{"events_cbg_by_option", "component_container", {"--executor-type", "events-cbg"}, false},
        Container{"events_by_option", "component_container", {"--executor-type=events"}, false},
        Container{"isolated", "component_container_isolated", {}, true},
        Container{"isolated_by_option", "component_container", {"--isolated"}, true},
        Container{"isolated_events_cbg", "component_container", {"--isolated", "--executor-type", "events-cbg"}, true},
        Container{"isolated_several", "component_container_isolated", {"--use_multi_threaded_executor"}, true}),
    [](const auto& test) { return test.param.name; });

TEST(ComponentProgram, RunsItsComponent) {
  const test_support::Sandbox sandbox;
  RunningCommand talker(Command{{PREFIX "/lib/composition/talker_node", "--ros-args", "-r", "__node:=mouth"}});
  EXPECT_TRUE(talker.wait_for_output("[mouth]: Publishing: 'Hello World: 1'")) << talker.err();
  talker.send_signal(SIGINT);
  EXPECT_EQ(talker.wait().exit_code, 0);
}

}  // namespace
