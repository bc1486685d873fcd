// SPDX-License-Identifier: Apache-2.0
// launch-ros-client as the launcher sees it: the real program asks nodes of this test over DDS.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <filesystem>
#include <future>
#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <optional>
#include <rcl_interfaces/msg/parameter_type.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <thread>

#include "launcher/ros/ros_client_process.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace {

using namespace std::chrono_literals;
using launch::RosAnswer;
using launch::RosRequest;
using testing::ElementsAre;
using testing::IsEmpty;
namespace composition = composition_interfaces::srv;
namespace lifecycle = lifecycle_msgs::srv;

launch::Environment own_environment() {
  launch::Environment environment;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text(*variable);
    environment.emplace(std::string(text.substr(0, text.find('='))), std::string(text.substr(text.find('=') + 1)));
  }
  return environment;
}

// The direct child of this process with that name; -1 when there is none.
pid_t child_called(const std::string& name) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string directory = entry.path().filename();
    if (directory.find_first_not_of("0123456789") != std::string::npos) {
      continue;
    }
    try {
      // "PID (COMMAND) STATE PARENT …", the command cut at fifteen characters
      const std::string stat = test_support::read_file(entry.path() / "stat");
      const std::size_t begin = stat.find('(') + 1;
      const std::size_t end = stat.rfind(')');
      if (stat.substr(begin, end - begin) == name.substr(0, 15) && std::stoi(stat.substr(end + 4)) == ::getpid()) {
        return std::stoi(directory);
      }
    } catch (const std::exception&) {
      // the process has gone meanwhile
    }
  }
  return -1;
}

class RosClientTest : public testing::Test {
 protected:
  RosClientTest() {
    rclcpp::init(0, nullptr, rclcpp::InitOptions(), rclcpp::SignalHandlerOptions::None);
    node_ = std::make_shared<rclcpp::Node>("peer", "ns");
    executor_ = std::make_unique<rclcpp::executors::SingleThreadedExecutor>();
    executor_->add_node(node_);
  }
  ~RosClientTest() override {
    if (spinner_.joinable()) {
      executor_->cancel();
      spinner_.join();
    }
    executor_.reset();
    node_.reset();
    rclcpp::shutdown();
  }

  // Serves the nodes that were created so far and those that will be.
  void spin() {
    spinner_ = std::thread([this] { executor_->spin(); });
  }

  RosAnswer ask(const RosRequest& request, launch::Duration timeout = 0s) {
    std::optional<RosAnswer> answer;
    const auto source = client_.ask(request, environment_, timeout, [&](const RosAnswer& given) {
      answer = given;
      loop_->quit();
    });
    EXPECT_FALSE(answer);
    while (!answer) {
      loop_->run();  // another answer may end the loop
    }
    return *answer;
  }

  test_support::Sandbox sandbox_;
  launch::Environment environment_ = own_environment();
  std::unique_ptr<launch::EventLoop> loop_ = launch::make_sd_event_loop();
  launch::RosClientProcess client_{*loop_, LAUNCH_ROS_CLIENT};
  rclcpp::Node::SharedPtr node_;
  std::unique_ptr<rclcpp::executors::SingleThreadedExecutor> executor_;
  std::thread spinner_;
};

TEST_F(RosClientTest, LoadsListsAndUnloadsNodesOfAContainer) {
  std::promise<composition::LoadNode::Request> request_promise;
  const auto load = node_->create_service<composition::LoadNode>(
      "/c/_container/load_node", [&](const std::shared_ptr<composition::LoadNode::Request> request,
                                     std::shared_ptr<composition::LoadNode::Response> response) {
        request_promise.set_value(*request);
        response->success = true;
        response->full_node_name = "/left/talker";
        response->unique_id = 5;
      });
  const auto list = node_->create_service<composition::ListNodes>(
      "/c/_container/list_nodes", [](const std::shared_ptr<composition::ListNodes::Request>,
                                     std::shared_ptr<composition::ListNodes::Response> response) {
        response->full_node_names = {"/left/talker"};
        response->unique_ids = {5};
      });
  const auto unload = node_->create_service<composition::UnloadNode>(
      "/c/_container/unload_node", [](const std::shared_ptr<composition::UnloadNode::Request> request,
                                      std::shared_ptr<composition::UnloadNode::Response> response) {
        response->success = request->unique_id == 5;
        response->error_message = response->success ? "" : "No node found with unique_id: 6";
      });
  spin();

  using launch::ParameterScalar;
  using Scalars = std::vector<ParameterScalar>;
  launch::ComposableNode node;
  node.package = "demo";
  node.plugin = "demo::Talker";
  node.name = "talker";
  node.name_space = "/left";
  node.remaps = {{"chatter", "/out"}};
  node.parameters = {{"twice", ParameterScalar(std::string("no"))},
                     {"rate", ParameterScalar(2.0)},
                     {"twice", ParameterScalar(std::int64_t(1))},
                     {"list", Scalars{std::string("a"), std::string("b")}},
                     {"empty", Scalars{}}};
  node.extra_arguments = {{"use_intra_process_comms", ParameterScalar(true)}};
  const RosAnswer loaded = ask(launch::LoadNode{"/c", node});
  EXPECT_TRUE(loaded.ok) << loaded.error;
  EXPECT_EQ(loaded.node, "/left/talker");
  EXPECT_EQ(loaded.unique_id, 5U);
  const composition::LoadNode::Request seen = request_promise.get_future().get();
  EXPECT_EQ(seen.package_name, "demo");
  EXPECT_EQ(seen.plugin_name, "demo::Talker");
  EXPECT_EQ(seen.node_name, "talker");
  EXPECT_EQ(seen.node_namespace, "/left");
  EXPECT_THAT(seen.remap_rules, ElementsAre("chatter:=/out"));
  ASSERT_EQ(seen.parameters.size(), 4U);  // the last parameter of a name wins
  EXPECT_EQ(seen.parameters[0].name, "twice");
  EXPECT_EQ(seen.parameters[0].value.type, rcl_interfaces::msg::ParameterType::PARAMETER_INTEGER);
  EXPECT_EQ(seen.parameters[0].value.integer_value, 1);
  EXPECT_EQ(seen.parameters[0].value.string_value, "");
  EXPECT_EQ(seen.parameters[1].value.type, rcl_interfaces::msg::ParameterType::PARAMETER_DOUBLE);
  EXPECT_EQ(seen.parameters[1].value.double_value, 2.0);
  EXPECT_EQ(seen.parameters[2].value.type, rcl_interfaces::msg::ParameterType::PARAMETER_STRING_ARRAY);
  EXPECT_THAT(seen.parameters[2].value.string_array_value, ElementsAre("a", "b"));
  EXPECT_EQ(seen.parameters[3].value.type, rcl_interfaces::msg::ParameterType::PARAMETER_BYTE_ARRAY);
  ASSERT_EQ(seen.extra_arguments.size(), 1U);
  EXPECT_TRUE(seen.extra_arguments[0].value.bool_value);

  const RosAnswer listed = ask(launch::ListNodes{"/c"});
  EXPECT_THAT(listed.nodes, ElementsAre("/left/talker"));
  EXPECT_THAT(listed.ids, ElementsAre(5U));
  EXPECT_TRUE(ask(launch::UnloadNode{"/c", 5}).ok);
  const RosAnswer refused = ask(launch::UnloadNode{"/c", 6});
  EXPECT_FALSE(refused.ok);
  EXPECT_EQ(refused.error, "No node found with unique_id: 6");
}

TEST_F(RosClientTest, AMissingServiceIsWaitedForAndATimeOutSaysForWhat) {
  const RosAnswer answer = ask(launch::GetState{"/n"}, 300ms);
  EXPECT_FALSE(answer.ok);
  EXPECT_FALSE(answer.client_lost);
  EXPECT_EQ(answer.error, "waited in vain for the '/n/get_state' service (0.3 s)");

  rclcpp::Service<lifecycle::GetState>::SharedPtr service;
  spin();
  const auto later = loop_->after(200ms, [&] {
    service = node_->create_service<lifecycle::GetState>(
        "/n/get_state",
        [](const std::shared_ptr<lifecycle::GetState::Request>,
           std::shared_ptr<lifecycle::GetState::Response> response) { response->current_state.label = "inactive"; });
  });
  EXPECT_EQ(ask(launch::GetState{"/n"}).state, "inactive");
}

// A container that was killed stays in the graph for a while. The request must also reach its successor.
TEST_F(RosClientTest, ARequestIsSentAgainToAServiceThatAppearsLater) {
  using Service = rclcpp::Service<lifecycle::GetState>;
  std::atomic<int> asked{0};
  const auto mute = node_->create_service<lifecycle::GetState>(
      "/n/get_state", [&](std::shared_ptr<Service>, std::shared_ptr<rmw_request_id_t>,
                          std::shared_ptr<lifecycle::GetState::Request>) { ++asked; });
  spin();
  const auto successor = std::make_shared<rclcpp::Node>("successor");
  Service::SharedPtr service;
  std::function<void()> watch;
  launch::EventLoop::SourcePtr timer;
  watch = [&] {  // when the first container has the request
    if (asked == 0) {
      timer = loop_->after(10ms, watch);
      return;
    }
    service = successor->create_service<lifecycle::GetState>(
        "/n/get_state",
        [](const std::shared_ptr<lifecycle::GetState::Request>,
           std::shared_ptr<lifecycle::GetState::Response> response) { response->current_state.label = "active"; });
    executor_->add_node(successor);
  };
  timer = loop_->after(10ms, watch);
  EXPECT_EQ(ask(launch::GetState{"/n"}).state, "active");
}

TEST_F(RosClientTest, AServiceThatGoesWithoutAnAnswerIsAnError) {
  using Service = rclcpp::Service<lifecycle::GetState>;
  std::atomic<bool> asked{false};
  Service::SharedPtr service = node_->create_service<lifecycle::GetState>(
      "/n/get_state", [&](std::shared_ptr<Service>, std::shared_ptr<rmw_request_id_t>,
                          std::shared_ptr<lifecycle::GetState::Request>) { asked = true; });
  spin();
  std::function<void()> watch;
  launch::EventLoop::SourcePtr timer;
  watch = [&] {
    if (asked) {
      service.reset();
    } else {
      timer = loop_->after(10ms, watch);
    }
  };
  timer = loop_->after(10ms, watch);
  const RosAnswer answer = ask(launch::GetState{"/n"});
  EXPECT_FALSE(answer.ok);
  EXPECT_EQ(answer.error, "the '/n/get_state' service has gone before it answered");
}

TEST_F(RosClientTest, StatesAreChangedAndWaitedFor) {
  std::string state = "unconfigured";
  std::mutex mutex;
  const auto events = node_->create_publisher<lifecycle_msgs::msg::TransitionEvent>("/n/transition_event", 10);
  const auto get_state = node_->create_service<lifecycle::GetState>(
      "/n/get_state", [&](const std::shared_ptr<lifecycle::GetState::Request>,
                          std::shared_ptr<lifecycle::GetState::Response> response) {
        const std::lock_guard lock(mutex);
        response->current_state.label = state;
      });
  const auto change_state = node_->create_service<lifecycle::ChangeState>(
      "/n/change_state", [&](const std::shared_ptr<lifecycle::ChangeState::Request> request,
                             std::shared_ptr<lifecycle::ChangeState::Response> response) {
        const std::lock_guard lock(mutex);
        response->success = request->transition.label == "configure" && request->transition.id == 1;
        if (response->success) {
          EXPECT_EQ(events->get_subscription_count(), 2U);  // the watch is known before the change
          lifecycle_msgs::msg::TransitionEvent event;
          event.start_state.label = state;
          event.goal_state.label = state = "inactive";
          events->publish(event);
        }
      });
  spin();
  EXPECT_TRUE(ask(launch::StateReached{"/n", "unconfigured"}).ok);
  EXPECT_FALSE(ask(launch::ChangeState{"/n", "activate"}).ok);

  std::vector<std::string> told;
  const auto watch = client_.ask(launch::WatchTransitions{"/n"}, environment_, 0s, [&](const RosAnswer& answer) {
    told.push_back(answer.previous_state + " to " + answer.state);
    loop_->quit();
  });
  std::optional<RosAnswer> reached;
  const auto wait = client_.ask(launch::StateReached{"/n", "inactive"}, environment_, 0s, [&](const RosAnswer& answer) {
    if (answer.seen.empty()) {
      reached = answer;
      loop_->quit();
    } else {
      EXPECT_EQ(answer.seen, "unconfigured");
    }
  });
  EXPECT_TRUE(ask(launch::ChangeState{"/n", "configure"}).ok);
  while (!reached || told.empty()) {
    loop_->run();
  }
  EXPECT_EQ(reached->state, "inactive");
  EXPECT_THAT(told, ElementsAre("unconfigured to inactive"));
}

TEST_F(RosClientTest, ParametersReachTheirValues) {
  node_->declare_parameter("rate", 10);
  node_->declare_parameter("list", std::vector<double>{1.0, 2.0});
  spin();
  using Items = std::vector<launch::ParameterScalar>;
  EXPECT_TRUE(ask(launch::ParameterReached{"/ns/peer", {"rate", launch::ParameterScalar(10.0)}}).ok);
  EXPECT_TRUE(ask(launch::ParameterReached{"/ns/peer", {"list", Items{std::int64_t(1), 2.0}}}).ok);
  EXPECT_EQ(ask(launch::ParameterReached{"/ns/peer", {"list", Items{1.0, 3.0}}}).seen, "it is (1.0, 2.0)");
  EXPECT_EQ(ask(launch::ParameterReached{"/ns/peer", {"other", Items{}}}).seen, "it is not set");

  std::vector<std::string> told;
  const auto wait =
      client_.ask(launch::ParameterReached{"/ns/peer", {"rate", launch::ParameterScalar(std::int64_t(20))}},
                  environment_, 0s, [&](const RosAnswer& answer) {
                    told.push_back(answer.ok ? "ok" : answer.seen);
                    loop_->quit();
                  });
  loop_->run();
  node_->set_parameter(rclcpp::Parameter("rate", 20));
  while (told.size() < 2) {
    loop_->run();
  }
  EXPECT_THAT(told, ElementsAre("it is 10", "ok"));
}

TEST_F(RosClientTest, MessagesAreCountedOnce) {
  std::optional<launch::SeenMessages> seen;
  const auto watch = client_.ask(launch::WatchMessages{"/chatter", "std_msgs/msg/String", "data != 'b'"}, environment_,
                                 0s, [&](const RosAnswer& answer) {
                                   EXPECT_TRUE(answer.ok) << answer.error;
                                   seen = answer.messages;
                                   loop_->quit();
                                 });
  // Its subscriptions are a best-effort one, a reliable one, and one for what publishers keep.
  const auto publisher = node_->create_publisher<std_msgs::msg::String>("/chatter", rclcpp::QoS(10).transient_local());
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (publisher->get_subscription_count() < 3 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(5ms);
  }
  for (const char* const text : {"a", "b", "c"}) {
    std_msgs::msg::String message;
    message.data = text;
    publisher->publish(message);
  }
  while (!seen || seen->all < 3) {
    loop_->run();
  }
  EXPECT_EQ(seen->all, 3U);
  EXPECT_EQ(seen->matching, 2U);
  EXPECT_THAT(seen->last, ElementsAre("{data: a}", "{data: b}", "{data: c}"));
  EXPECT_EQ(seen->publishers, 1U);
  EXPECT_THAT(seen->types, ElementsAre("std_msgs/msg/String"));
  EXPECT_GT(seen->last_ns, seen->first_ns);
}

TEST_F(RosClientTest, TransitionsHaveNames) {
  const RosAnswer answer = ask(launch::ChangeState{"/n", "dance"});
  EXPECT_FALSE(answer.ok);
  EXPECT_EQ(answer.error, "there is no transition 'dance'");
}

TEST_F(RosClientTest, ConditionsHoldOnceTheGraphShowsIt) {
  EXPECT_TRUE(ask(launch::NodePresent{"/ns/peer"}).ok);
  EXPECT_TRUE(ask(launch::ServicePresent{"/ns/peer/get_parameters"}).ok);
  EXPECT_EQ(ask(launch::NodePresent{"/peer"}, 200ms).error, "waited in vain for the node '/peer' (0.2 s)");
  EXPECT_EQ(ask(launch::ServicePresent{"/none"}, 200ms).error, "waited in vain for the '/none' service (0.2 s)");
  EXPECT_EQ(ask(launch::TopicPresent{"/chatter"}, 200ms).error, "waited in vain for a publisher of '/chatter' (0.2 s)");
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher;
  const auto later =
      loop_->after(100ms, [&] { publisher = node_->create_publisher<std_msgs::msg::String>("/chatter", 10); });
  EXPECT_TRUE(ask(launch::TopicPresent{"/chatter"}).ok);
}

TEST_F(RosClientTest, APublisherIsNoMessage) {
  const auto publisher = node_->create_publisher<std_msgs::msg::String>("/chatter", rclcpp::QoS(10).best_effort());
  EXPECT_EQ(ask(launch::MessagePublished{"/chatter"}, 500ms).error,
            "waited in vain for a message on '/chatter' (0.5 s)");
  std::function<void()> publish;
  launch::EventLoop::SourcePtr timer;
  publish = [&] {
    publisher->publish(std_msgs::msg::String());
    timer = loop_->after(50ms, publish);
  };
  timer = loop_->after(50ms, publish);
  EXPECT_TRUE(ask(launch::MessagePublished{"/chatter"}).ok);
}

TEST_F(RosClientTest, AMessageThatIsKeptForLateComersCounts) {
  const auto publisher =
      node_->create_publisher<std_msgs::msg::String>("/map", rclcpp::QoS(1).reliable().transient_local());
  publisher->publish(std_msgs::msg::String());
  EXPECT_TRUE(ask(launch::MessagePublished{"/map"}).ok);
}

TEST_F(RosClientTest, TheEnvironmentChoosesTheGraph) {
  EXPECT_TRUE(ask(launch::NodePresent{"/ns/peer"}).ok);
  environment_["ROS_DOMAIN_ID"] = environment_.at("ROS_DOMAIN_ID") == "5" ? "6" : "5";
  EXPECT_FALSE(ask(launch::NodePresent{"/ns/peer"}, 500ms).ok);
}

TEST_F(RosClientTest, AClientThatIsKilledIsToldAndTheNextRequestStartsAnother) {
  EXPECT_TRUE(ask(launch::NodePresent{"/ns/peer"}).ok);
  const auto kill = loop_->after(50ms, [] { ::kill(child_called("launch-ros-client"), SIGKILL); });
  const RosAnswer lost = ask(launch::NodePresent{"/nowhere"});
  EXPECT_TRUE(lost.client_lost);
  EXPECT_EQ(lost.error, "launch-ros-client was ended by SIGKILL");
  EXPECT_TRUE(ask(launch::NodePresent{"/ns/peer"}).ok);
}

TEST_F(RosClientTest, AProgramThatIsMissingIsToldLater) {
  launch::RosClientProcess missing(*loop_, "/nowhere/launch-ros-client");
  std::optional<RosAnswer> answer;
  const auto source = missing.ask(launch::NodePresent{"/n"}, environment_, 0s, [&](const RosAnswer& given) {
    answer = given;
    loop_->quit();
  });
  EXPECT_FALSE(answer);
  loop_->run();
  EXPECT_TRUE(answer->client_lost);
  EXPECT_EQ(answer->error, "cannot start '/nowhere/launch-ros-client': No such file or directory");
}

TEST_F(RosClientTest, ACancelledRequestIsNotAnswered) {
  std::vector<std::string> answered;
  auto cancelled = client_.ask(launch::NodePresent{"/ns/peer"}, environment_, 0s,
                               [&](const RosAnswer&) { answered.emplace_back("cancelled"); });
  cancelled.reset();
  EXPECT_TRUE(ask(launch::NodePresent{"/ns/peer"}).ok);
  EXPECT_THAT(answered, IsEmpty());
}

}  // namespace
