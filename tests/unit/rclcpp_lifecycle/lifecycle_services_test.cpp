// SPDX-License-Identifier: Apache-2.0
// A managed node that other nodes ask for its state and lead through its states.
#include <gmock/gmock.h>

#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_available_states.hpp>
#include <lifecycle_msgs/srv/get_available_transitions.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::msg::TransitionEvent;
using lifecycle_msgs::srv::ChangeState;
using lifecycle_msgs::srv::GetAvailableStates;
using lifecycle_msgs::srv::GetAvailableTransitions;
using lifecycle_msgs::srv::GetState;
using rclcpp_lifecycle::LifecycleNode;
using testing::ElementsAre;

class LifecycleServicesTest : public RosTest {
 protected:
  LifecycleServicesTest() {
    executor_.add_node(node_->get_node_base_interface());
    executor_.add_node(other_);
  }

  template <typename ServiceT>
  typename ServiceT::Response ask(const std::string& service,
                                  const typename ServiceT::Request& request = typename ServiceT::Request()) {
    const auto client = other_->create_client<ServiceT>("/here/managed/" + service);
    EXPECT_TRUE(client->wait_for_service(kPatience));
    auto future = client->async_send_request(std::make_shared<typename ServiceT::Request>(request));
    EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    return *future.get();
  }

  bool change_state(uint8_t id, const std::string& label = "") {
    ChangeState::Request request;
    request.transition.id = id;
    request.transition.label = label;
    return ask<ChangeState>("change_state", request).success;
  }
  std::string state() { return ask<GetState>("get_state").current_state.label; }

  rclcpp::executors::SingleThreadedExecutor executor_;
  const LifecycleNode::SharedPtr node_ = std::make_shared<LifecycleNode>("managed", "here");
  const rclcpp::Node::SharedPtr other_ = std::make_shared<rclcpp::Node>("other");
};

TEST_F(LifecycleServicesTest, LeadTheNode) {
  EXPECT_EQ(state(), "unconfigured");
  EXPECT_TRUE(change_state(Transition::TRANSITION_CONFIGURE));
  EXPECT_EQ(ask<GetState>("get_state").current_state.id, 2);
  EXPECT_TRUE(change_state(0, "activate"));
  EXPECT_EQ(state(), "active");
  // The label has precedence.
  EXPECT_TRUE(change_state(Transition::TRANSITION_ACTIVE_SHUTDOWN, "deactivate"));
  EXPECT_EQ(state(), "inactive");
  EXPECT_TRUE(change_state(0, "shutdown"));
  EXPECT_EQ(state(), "finalized");
}

TEST_F(LifecycleServicesTest, TellWhenATransitionFailed) {
  EXPECT_FALSE(change_state(Transition::TRANSITION_ACTIVATE));
  EXPECT_FALSE(change_state(0, "dance"));
  EXPECT_EQ(state(), "unconfigured");
  node_->register_on_configure([](const auto&) { return LifecycleNode::CallbackReturn::FAILURE; });
  EXPECT_FALSE(change_state(Transition::TRANSITION_CONFIGURE));
  EXPECT_EQ(state(), "unconfigured");
}

TEST_F(LifecycleServicesTest, TellStatesAndTransitions) {
  const auto states = ask<GetAvailableStates>("get_available_states").available_states;
  ASSERT_EQ(states.size(), 11u);
  EXPECT_EQ(states[5].id, 10);
  EXPECT_EQ(states[5].label, "configuring");

  const auto transitions = ask<GetAvailableTransitions>("get_available_transitions").available_transitions;
  ASSERT_EQ(transitions.size(), 2u);
  EXPECT_EQ(transitions[1].transition.id, Transition::TRANSITION_UNCONFIGURED_SHUTDOWN);
  EXPECT_EQ(transitions[1].transition.label, "shutdown");
  EXPECT_EQ(transitions[1].start_state.label, "unconfigured");
  EXPECT_EQ(transitions[1].goal_state.label, "shuttingdown");
  EXPECT_EQ(transitions[1].goal_state.id, 12);

  EXPECT_EQ(ask<GetAvailableTransitions>("get_transition_graph").available_transitions.size(), 25u);
}

TEST_F(LifecycleServicesTest, TransitionsArePublished) {
  std::vector<std::string> events;
  uint64_t last_time = 0;
  const auto subscription = other_->create_subscription<TransitionEvent>(
      "/here/managed/transition_event", 10, [&](const TransitionEvent& event) {
        events.push_back(std::to_string(event.transition.id) + " " + event.transition.label + ": " +
                         event.start_state.label + " > " + event.goal_state.label);
        EXPECT_GE(event.timestamp, last_time);
        last_time = event.timestamp;
      });
  ASSERT_TRUE(spin_until(executor_, [&] { return subscription->get_publisher_count() == 1; }));
  node_->configure();
  node_->activate();
  EXPECT_TRUE(spin_until(executor_, [&] { return events.size() == 4; }));
  EXPECT_THAT(events,
              ElementsAre("1 configure: unconfigured > configuring", "10 transition_success: configuring > inactive",
                          "3 activate: inactive > activating", "30 transition_success: activating > active"));
  EXPECT_GT(last_time, 1'500'000'000'000'000'000u);
}

TEST_F(LifecycleServicesTest, ServicesGoWithTheNode) {
  auto short_lived = std::make_shared<LifecycleNode>("short_lived");
  EXPECT_EQ(other_->count_services("/short_lived/change_state"), 1u);
  short_lived.reset();
  EXPECT_EQ(other_->count_services("/short_lived/change_state"), 0u);
  EXPECT_EQ(other_->count_publishers("/short_lived/transition_event"), 0u);
}

}  // namespace
