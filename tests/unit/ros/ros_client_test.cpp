// SPDX-License-Identifier: Apache-2.0
// launch-ros-client as the launcher sees it: calls of services, and the end of the program.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <composition_interfaces/srv/list_nodes.hpp>
#include <composition_interfaces/srv/load_node.hpp>
#include <composition_interfaces/srv/unload_node.hpp>
#include <filesystem>
#include <future>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <optional>
#include <rcl_interfaces/msg/parameter_type.hpp>

#include "ros_client_fixture.hpp"
#include "tests/support/command.hpp"
#include "tests/support/emulated.hpp"

namespace {

using namespace std::chrono_literals;
using launch::RosAnswer;
using testing::ElementsAre;
using testing::IsEmpty;
namespace composition = composition_interfaces::srv;
namespace lifecycle = lifecycle_msgs::srv;

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
  NEEDS_VFORK();
  launch::RosClientProcess missing(*loop_, nullptr, "/nowhere/launch-ros-client");
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
