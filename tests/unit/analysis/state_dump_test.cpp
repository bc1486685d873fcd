// SPDX-License-Identifier: Apache-2.0
// Objects that a state dump reports again.
#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

bool is_init_event(const ros2::AnyEvent& event) {
  return std::visit(
      []<class Event>(const Event&) {
        if constexpr (!std::is_same_v<Event, std::monostate>) {
          return Event::kName.ends_with("_init") || Event::kName.ends_with("_added") ||
                 Event::kName.ends_with("_register") || Event::kName.ends_with("_link_node");
        } else {
          return false;
        }
      },
      event);
}

// Gives the endpoints of the middleware identities like those of real ones.
ros2::AnyEvent with_gid(ros2::AnyEvent event) {
  std::visit(
      []<class Event>(Event& each) {
        if constexpr (requires { each.gid; }) {
          each.gid.size = 16;
          if constexpr (requires { each.rmw_publisher_handle; }) {
            each.gid.bytes[0] = static_cast<std::uint8_t>(each.rmw_publisher_handle);
          } else if constexpr (requires { each.rmw_subscription_handle; }) {
            each.gid.bytes[1] = static_cast<std::uint8_t>(each.rmw_subscription_handle);
          }
        }
      },
      event);
  return event;
}

// Ping and pong, with a dump of the objects of both processes before the event `position`.
Ros2Results ping_pong_with_state_dump(std::size_t position) {
  const std::vector<testing::SequenceEvent> sequence = testing::ping_pong_sequence();
  Ros2Analysis analysis;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (i == position) {
      for (std::size_t known = 0; known < i; ++known) {
        const auto& [time, thread, event] = sequence[known];
        if (is_init_event(event)) {
          analysis.on_event({sequence[i].time_ns, static_cast<ProcessId>(thread.vpid), 99}, with_gid(event));
        }
      }
    }
    const auto& [time, thread, event] = sequence[i];
    analysis.on_event({time, static_cast<ProcessId>(thread.vpid), thread.vtid}, with_gid(event));
  }
  return analysis.finish();
}

TEST(StateDump, IsTheSameWithAStateDumpAnywhere) {
  const std::size_t end = testing::ping_pong_sequence().size();
  const Ros2Results without = ping_pong_with_state_dump(end);
  ASSERT_EQ(without.callbacks.size(), 3u);
  for (std::size_t position = 1; position < end; ++position) {
    SCOPED_TRACE(position);
    const Ros2Results with = ping_pong_with_state_dump(position);
    ASSERT_EQ(with.callbacks.size(), without.callbacks.size());
    for (std::size_t i = 0; i < with.callbacks.size(); ++i) {
      EXPECT_EQ(with.callbacks[i].node, without.callbacks[i].node);
      EXPECT_EQ(with.callbacks[i].owner_name, without.callbacks[i].owner_name);
      EXPECT_EQ(with.callbacks[i].symbol, without.callbacks[i].symbol);
      EXPECT_EQ(with.callbacks[i].durations.count, without.callbacks[i].durations.count);
    }
    ASSERT_EQ(with.topics.size(), without.topics.size());
    for (std::size_t i = 0; i < with.topics.size(); ++i) {
      EXPECT_EQ(with.topics[i].publishers, without.topics[i].publishers);
      EXPECT_EQ(with.topics[i].subscriptions, without.topics[i].subscriptions);
      EXPECT_EQ(with.topics[i].published, without.topics[i].published);
      EXPECT_EQ(with.topics[i].latency.count, without.topics[i].latency.count);
    }
    EXPECT_EQ(with.internal_messages, without.internal_messages);
    EXPECT_EQ(with.unknown_messages, 0u);
  }
}

TEST(StateDump, NamesACallbackThatRanBeforeTheStateDump) {
  Feed feed;
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::RclNodeInit{7, 8, "node", "/"})(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed(ros2::RclcppCallbackRegister{0xcb, "tick()"})(ros2::RclcppTimerLinkNode{1, 7});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].node, "/node");
  EXPECT_EQ(results.callbacks[0].symbol, "tick()");
  EXPECT_EQ(results.callbacks[0].durations.count, 2u);
}

}  // namespace
}  // namespace tracing
