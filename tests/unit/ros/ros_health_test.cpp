// SPDX-License-Identifier: Apache-2.0
// launch-ros-client as the watches of the launcher see it: traffic of topics, services, states.
#include <gmock/gmock.h>

#include <atomic>
#include <functional>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <optional>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/trigger.hpp>

#include "ros_client_fixture.hpp"

namespace {

using namespace std::chrono_literals;
using launch::RosAnswer;
using launch::ServiceFinding;

class RosHealthTest : public RosClientTest {
 protected:
  // Runs the loop until an answer to the request is the one that is wanted.
  void await(const launch::RosRequest& request, const std::function<bool(const RosAnswer&)>& is_wanted) {
    bool has_come = false;
    const auto source = client_.ask(request, environment_, 0s, [&](const RosAnswer& answer) {
      EXPECT_TRUE(answer.ok) << answer.error;
      has_come = has_come || is_wanted(answer);
      if (has_come) {
        loop_->quit();
      }
    });
    loop_->run();
  }
  static std::function<bool(const RosAnswer&)> is(ServiceFinding finding) {
    return [finding](const RosAnswer& answer) { return answer.found == finding; };
  }
};

TEST_F(RosHealthTest, TheTrafficOfATopicCountsWhatIsPublished) {
  await(launch::MeterTopic{"/beats", 100ms},
        [](const RosAnswer& answer) { return answer.traffic && answer.traffic->publishers == 0; });
  const auto publisher = node_->create_publisher<std_msgs::msg::String>("/beats", 10);
  // More in one look than a subscription keeps: they are counted by their numbers.
  std::atomic<int> published = 0;
  const auto timer = node_->create_wall_timer(1ms, [&] {
    publisher->publish(std_msgs::msg::String());
    ++published;
  });
  spin();
  std::uint64_t counted = 0;
  await(launch::MeterTopic{"/beats", 200ms}, [&](const RosAnswer& answer) {
    counted += answer.traffic->messages;
    return counted >= 300 && answer.traffic->publishers == 1;
  });
  EXPECT_LE(counted, static_cast<std::uint64_t>(published) + 1);
}

TEST_F(RosHealthTest, AServiceIsMissedAndFound) {
  await(launch::AskService{"/ns/reset", 100ms}, is(ServiceFinding::kGone));
  const auto service = node_->create_service<std_srvs::srv::Trigger>(
      "/ns/reset",
      [](const std_srvs::srv::Trigger::Request::SharedPtr&, const std_srvs::srv::Trigger::Response::SharedPtr&) {
        ADD_FAILURE() << "only harmless services are called";
      });
  spin();
  await(launch::AskService{"/ns/reset", 100ms}, is(ServiceFinding::kFound));
}

TEST_F(RosHealthTest, AServiceOfParametersHasToAnswer) {
  // Nobody spins yet.
  await(launch::AskService{"/ns/peer/get_parameters", 100ms}, is(ServiceFinding::kAsked));
  spin();
  await(launch::AskService{"/ns/peer/get_parameters", 100ms}, is(ServiceFinding::kFound));
}

TEST_F(RosHealthTest, AStateIsAskedForAgainAndAgain) {
  std::atomic<int> questions = 0;
  const auto get_state = node_->create_service<lifecycle_msgs::srv::GetState>(
      "/n/get_state", [&](const lifecycle_msgs::srv::GetState::Request::SharedPtr&,
                          const lifecycle_msgs::srv::GetState::Response::SharedPtr& response) {
        response->current_state.label = ++questions < 3 ? "inactive" : "active";
      });
  spin();
  std::vector<std::string> told;
  await(launch::AskState{"/n", 50ms}, [&](const RosAnswer& answer) {
    if (answer.found == ServiceFinding::kFound) {
      told.push_back(answer.state);
    }
    return answer.state == "active";
  });
  EXPECT_THAT(told, testing::ElementsAre("inactive", "active"));
}

}  // namespace
