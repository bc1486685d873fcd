// SPDX-License-Identifier: Apache-2.0
// launch-ros-client as the launcher sees it: what it waits for in the graph, in states, parameters and messages.
#include <gmock/gmock.h>

#include <functional>
#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <optional>
#include <std_msgs/msg/string.hpp>

#include "ros_client_fixture.hpp"

namespace {

using namespace std::chrono_literals;
using launch::RosAnswer;
using testing::ElementsAre;
namespace lifecycle = lifecycle_msgs::srv;

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

}  // namespace
