// SPDX-License-Identifier: Apache-2.0
// The events that max-overhead may drop from a trace.
#include "tracing/record/plan/event_classes.hpp"

#include <gmock/gmock.h>

#include <set>

#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace {

using testing::ElementsAre;
using tracing::ChannelPlan;
using tracing::DroppableClass;
using tracing::plan_channels;
using tracing::plan_drops;
using tracing::TraceConfig;

std::vector<ChannelPlan> channels(std::vector<std::string> events, bool init_channel = false) {
  TraceConfig config;
  config.events_ust = std::move(events);
  config.max_overhead = 0.02;
  config.init_channel = init_channel;
  std::vector<std::string> warnings;
  return plan_channels(config, warnings);
}

std::vector<std::string> names(const std::vector<DroppableClass>& drops) {
  std::vector<std::string> found;
  for (const DroppableClass& drop : drops) {
    found.push_back(drop.name);
  }
  return found;
}

TEST(EventClasses, TogetherAreAllRunTimeEventsOfRos2ButTransitionsAndLinks) {
  std::set<std::string> dropped;
  for (const DroppableClass& drop : plan_drops(tracing::droppable_classes(), channels({"ros2:*"}, true))) {
    for (const tracing::DroppableRule& rule : drop.rules) {
      EXPECT_EQ(rule.channel, "ros2");
      dropped.insert(rule.event);
    }
  }
  const auto& init = tracing::initialisation_ros_events();
  for (const std::string& event : tracing::default_ros_events()) {
    const bool stays = std::find(init.begin(), init.end(), event) != init.end() ||
                       event == "ros2:rcl_lifecycle_transition" || event.starts_with("ros2:message_link");
    EXPECT_NE(dropped.contains(event), stays) << event;
  }
}

TEST(EventClasses, AreDroppedInTheOrderThatIsAskedForAndNothingElseIs) {
  const auto drops = plan_drops({"callbacks", "ros2:rmw_*", "messages", "executor"},
                                channels({"ros2:callback_start", "ros2:rmw_*", "ros2:rclcpp_executor_execute"}));
  EXPECT_THAT(names(drops), ElementsAre("callbacks", "ros2:rmw_*", "executor"));
  for (const tracing::DroppableRule& rule : drops[1].rules) {
    EXPECT_EQ(rule.event.find("_init"), std::string::npos) << rule.event << ": the initialisation of objects stays";
  }
}

TEST(EventClasses, PatternsOfOtherProvidersAreDroppedAsAWhole) {
  const auto drops = plan_drops({"my_app:*"}, channels({"my_app:*", "ros2:rcl_init"}));
  ASSERT_THAT(names(drops), ElementsAre("my_app:*"));
  EXPECT_EQ(drops[0].rules.at(0).event, "my_app:*");
}

TEST(EventClasses, APatternOfRos2ExtBelongsToAClassIfAllItsEventsDo) {
  const auto drops = plan_drops(
      {"executor", "services"},
      channels({"ros2_ext:*", "ros2_ext:rclcpp_executor_*", "ros2_ext:rclcpp_client_callback_*", "ros2_ext:rmw_*"}));
  ASSERT_THAT(names(drops), ElementsAre("executor", "services"));
  ASSERT_EQ(drops[0].rules.size(), 1u);
  EXPECT_EQ(drops[0].rules[0].event, "ros2_ext:rclcpp_executor_*");
  ASSERT_EQ(drops[1].rules.size(), 1u);
  EXPECT_EQ(drops[1].rules[0].event, "ros2_ext:rclcpp_client_callback_*");
}

TEST(EventClasses, PatternsOfRos2AreNamedOnceSoThatTheyCanBeSwitchedOff) {
  std::set<std::string> seen;
  const auto planned = channels({"ros2:*", "ros2:rcl_*", "ros2:callback_start"});
  for (const tracing::EventRule& rule : planned.at(0).events) {
    EXPECT_TRUE(seen.insert(rule.pattern).second) << rule.pattern;
  }
  EXPECT_EQ(seen.size(), 43u) << "42, and launch:cut";
}

}  // namespace
