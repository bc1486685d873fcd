// SPDX-License-Identifier: Apache-2.0
// The managed demo node, as a program and as a component. The other demo programs change its state and receive its
// messages.
#include <gmock/gmock.h>
#include <signal.h>

#include <composition_interfaces/srv/load_node.hpp>
#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>

#include "tests/support/command.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using composition_interfaces::srv::LoadNode;
using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::srv::ChangeState;
using test_support::Command;
using test_support::CommandResult;
using test_support::RunningCommand;
using testing::HasSubstr;

Command program(const std::string& name, std::vector<std::string> arguments = {}) {
  Command command{{PREFIX "/lib/lifecycle/" + name, "--ros-args"}};
  command.argv.insert(command.argv.end(), arguments.begin(), arguments.end());
  return command;
}

class LedTalker : public RosTest {
 protected:
  LedTalker() { executor_.add_node(node_); }

  void change_state(uint8_t transition) {
    ASSERT_TRUE(client_->wait_for_service(kPatience));
    auto request = std::make_shared<ChangeState::Request>();
    request->transition.id = transition;
    auto future = client_->async_send_request(request);
    ASSERT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    EXPECT_TRUE(future.get()->success) << unsigned{transition};
  }

  rclcpp::executors::SingleThreadedExecutor executor_;
  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("leader");
  const rclcpp::Client<ChangeState>::SharedPtr client_ = node_->create_client<ChangeState>("/lc_talker/change_state");
};

TEST_F(LedTalker, IsHeardByTheListenerWhileItIsActive) {
  RunningCommand talker(program("lifecycle_talker", {"-p", "period_ms:=10"}));
  RunningCommand listener(program("lifecycle_listener"));
  change_state(Transition::TRANSITION_CONFIGURE);
  EXPECT_TRUE(talker.wait_for_output("[lc_talker]: Lifecycle publisher is currently inactive.")) << talker.err();
  change_state(Transition::TRANSITION_ACTIVATE);
  EXPECT_TRUE(
      talker.wait_for_output("[lc_talker]: Lifecycle publisher is active. Publishing: [Lifecycle HelloWorld #"));
  EXPECT_TRUE(listener.wait_for_output("[lc_listener]: data_callback: Lifecycle HelloWorld #")) << listener.err();
  change_state(Transition::TRANSITION_ACTIVE_SHUTDOWN);
  EXPECT_TRUE(
      listener.wait_for_output("[lc_listener]: notify callback: Transition from state shuttingdown to finalized\n"))
      << listener.err();
  talker.send_signal(SIGINT);
  const CommandResult talked = talker.wait();
  EXPECT_EQ(talked.exit_code, 0) << talked.err;
  EXPECT_THAT(talked.err, HasSubstr("[lc_talker]: on shutdown is called from state active.\n"));
  listener.end_gently();
}

TEST(LifecycleNodes, ClientLeadsTheTalkerThroughItsLife) {
  const test_support::Sandbox sandbox;
  RunningCommand talker(program("lifecycle_talker"));
  const CommandResult result = test_support::run_command(program("lifecycle_service_client", {"-p", "period_ms:=0"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* state : {"unconfigured", "inactive", "active", "finalized"}) {
    EXPECT_THAT(result.err,
                HasSubstr("[lc_client]: Node /lc_talker/get_state has current state " + std::string(state) + ".\n"));
  }
}

TEST(LifecycleNodes, ClientTellsWhatFailed) {
  const test_support::Sandbox sandbox;
  RunningCommand talker(program("lifecycle_talker", {"-p", "period_ms:=-1", "-r", "__node:=broken"}));
  RunningCommand client(program("lifecycle_service_client", {"-p", "period_ms:=0", "-p", "node:=broken"}));
  const CommandResult result = client.wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("[lc_client]: Failed to trigger transition 1\n"));
}

class ManagedComponent : public RosTest {};

TEST_F(ManagedComponent, IsLoadedAndLedLikeAnyOther) {
  RunningCommand container(Command{{PREFIX "/lib/rclcpp_components/component_container"}});
  const auto node = std::make_shared<rclcpp::Node>("asker");
  const auto client = node->create_client<LoadNode>("/ComponentManager/_container/load_node");
  ASSERT_TRUE(client->wait_for_service(kPatience));
  auto request = std::make_shared<LoadNode::Request>();
  request->package_name = "lifecycle";
  request->plugin_name = "lifecycle::LifecycleTalker";
  request->node_name = "led";
  request->parameters = {rclcpp::Parameter("period_ms", 10).to_parameter_msg()};
  auto future = client->async_send_request(request);
  ASSERT_EQ(rclcpp::spin_until_future_complete(node, future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
  EXPECT_EQ(future.get()->full_node_name, "/led") << future.get()->error_message;
  const CommandResult result =
      test_support::run_command(program("lifecycle_service_client", {"-p", "period_ms:=0", "-p", "node:=led"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  container.send_signal(SIGINT);
  EXPECT_EQ(container.wait().exit_code, 0);
}

}  // namespace
