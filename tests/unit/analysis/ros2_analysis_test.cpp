#include "tracing/analysis/ros2_analysis.hpp"

#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"

namespace tracing {
namespace {

using Owner = CallbackResult::Owner;

// Feeds events of one thread at a time; each is 10 ns after the one before.
class Feed {
 public:
  Feed& in(Vpid vpid, std::int64_t vtid) {
    origin_.vpid = vpid;
    origin_.vtid = vtid;
    return *this;
  }
  Feed& operator()(const ros2::AnyEvent& event) {
    origin_.time_ns += 10;
    analysis_.on_event(origin_, event);
    return *this;
  }
  Feed& end(ros2::ObjectEnd::Kind kind, ros2::Handle handle) {
    origin_.time_ns += 10;
    analysis_.on_end(origin_, {kind, handle});
    return *this;
  }
  Ros2Results results() { return analysis_.finish(); }

 private:
  Origin origin_{0, 71, 71};
  Ros2Analysis analysis_;
};

const TopicResult& topic(const Ros2Results& results, const std::string& name) {
  for (const TopicResult& result : results.topics) {
    if (result.name == name) return result;
  }
  throw std::runtime_error("no topic " + name);
}

TEST(Ros2Analysis, FollowsPingAndPong) {
  Ros2Analysis analysis;
  for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
    analysis.on_event({time, thread.vpid, thread.vtid}, event);
  }
  const Ros2Results results = analysis.finish();

  ASSERT_EQ(results.callbacks.size(), 3u);
  const CallbackResult& pong_in_ping = results.callbacks[0];
  EXPECT_EQ(pong_in_ping.vpid, 71);
  EXPECT_EQ(pong_in_ping.node, "/ping");
  EXPECT_EQ(pong_in_ping.owner, Owner::kSubscription);
  EXPECT_EQ(pong_in_ping.owner_name, "/pong");
  EXPECT_EQ(pong_in_ping.symbol, "Ping::?(std::shared_ptr<std_msgs::msg::String>)");
  EXPECT_EQ(pong_in_ping.durations.count, 1u);
  EXPECT_EQ(pong_in_ping.durations.max_ns, 30'000);
  const CallbackResult& timer = results.callbacks[1];
  EXPECT_EQ(timer.node, "/ping");
  EXPECT_EQ(timer.owner, Owner::kTimer);
  EXPECT_EQ(timer.period_ns, 500'000'000);
  EXPECT_EQ(timer.durations.max_ns, 60'000);
  EXPECT_EQ(timer.unfinished, 0u);
  EXPECT_EQ(results.callbacks[2].vpid, 72);
  EXPECT_EQ(results.callbacks[2].node, "/pong");
  EXPECT_EQ(results.callbacks[2].owner_name, "/ping");

  ASSERT_EQ(results.topics.size(), 2u);
  const TopicResult& ping = results.topics[0];
  EXPECT_EQ(ping.name, "/ping");
  EXPECT_EQ(ping.publishers, 1u);
  EXPECT_EQ(ping.subscriptions, 1u);
  EXPECT_EQ(ping.published, 1u);
  EXPECT_EQ(ping.received, 1u);
  EXPECT_EQ(ping.published_only, 0u);
  EXPECT_EQ(ping.received_only, 0u);
  EXPECT_EQ(ping.latency.count, 1u);
  EXPECT_EQ(ping.latency.max_ns, 150'000) << "rmw_publish at 506.920 ms, callback_start at 507.070 ms";
  EXPECT_EQ(results.topics[1].latency.max_ns, 115'000);
  EXPECT_EQ(results.internal_messages, 2u) << "discovery: one published, one taken";
  EXPECT_EQ(results.unknown_messages, 0u);
}

TEST(Ros2Analysis, KeepsEqualAddressesOfTwoProcessesApart) {
  Feed feed;
  feed.in(71, 71)(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed.in(72, 72)(ros2::RclTimerInit{1, 200})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed.in(71, 71)(ros2::CallbackStart{0xcb, false});
  feed.in(72, 72)(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed.in(71, 71)(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].period_ns, 100);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 30);
  EXPECT_EQ(results.callbacks[1].period_ns, 200);
  EXPECT_EQ(results.callbacks[1].durations.max_ns, 10);
}

TEST(Ros2Analysis, KeepsAReentrantCallbackInTwoThreadsApart) {
  Feed feed;
  feed.in(71, 1)(ros2::CallbackStart{0xcb, false});
  feed.in(71, 2)(ros2::CallbackStart{0xcb, false});
  feed.in(71, 1)(ros2::CallbackEnd{0xcb});
  feed.in(71, 2)(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].durations.count, 2u);
  EXPECT_EQ(results.callbacks[0].durations.min_ns, 20);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 20);
}

TEST(Ros2Analysis, GivesAReusedAddressToTheNewestObject) {
  Feed feed;
  feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
      ros2::RclcppCallbackRegister{0xcb, "first"});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::RclTimerInit{1, 200})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
      ros2::RclcppCallbackRegister{0xcb, "second"});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].symbol, "first");
  EXPECT_EQ(results.callbacks[0].period_ns, 100);
  EXPECT_EQ(results.callbacks[0].durations.count, 1u);
  EXPECT_EQ(results.callbacks[1].symbol, "second");
  EXPECT_EQ(results.callbacks[1].period_ns, 200);
  EXPECT_EQ(results.callbacks[1].durations.count, 2u);
}

TEST(Ros2Analysis, TellsAnEqualObjectFromTheOneThatHasEnded) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  for (int life = 0; life < 2; ++life) {
    feed(ros2::RclNodeInit{2, 3, "node", "/"});
    feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(ros2::RclcppTimerLinkNode{1, 2});
    feed(ros2::RclcppCallbackRegister{0xcb, "tick"});
    feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
    feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclTimer, 1).end(Kind::kRclNode, 2);
  }

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  for (const CallbackResult& callback : results.callbacks) {
    EXPECT_EQ(callback.node, "/node");
    EXPECT_EQ(callback.symbol, "tick");
    EXPECT_EQ(callback.durations.count, 1u);
  }
}

TEST(Ros2Analysis, GivesTheHandleOfAnEndedObjectToNobody) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed(ros2::RmwPublisherInit{5, {}})(ros2::RclPublisherInit{6, 0, 5, "/topic", 1})(ros2::RmwPublish{5, 9, 1});
  feed.in(72, 72).end(Kind::kRclcppCallback, 0xcb);  // of another process
  feed.in(71, 71)(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclTimer, 1).end(Kind::kRclPublisher, 6).end(Kind::kRmwPublisher, 5);
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb})(ros2::RmwPublish{5, 9, 2});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner, Owner::kUnknown);
  EXPECT_EQ(results.callbacks[0].durations.count, 1u);
  EXPECT_EQ(results.callbacks[1].owner, Owner::kTimer);
  EXPECT_EQ(results.callbacks[1].durations.count, 1u);
  EXPECT_EQ(topic(results, "/topic").published, 1u);
  EXPECT_EQ(results.unknown_messages, 1u);
}

TEST(Ros2Analysis, EndsASubscriptionWithAllItsLayers) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  for (std::int64_t life = 1; life <= 2; ++life) {
    feed(ros2::RmwSubscriptionInit{1, {}})(ros2::RclSubscriptionInit{2, 0, 1, "/topic", 1});
    feed(ros2::RclcppSubscriptionInit{2, 3})(ros2::RclcppSubscriptionCallbackAdded{3, 0xcb});
    feed(ros2::RmwTake{1, 9, life, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
    feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclcppSubscription, 3).end(Kind::kRclSubscription, 2);
    feed.end(Kind::kRmwSubscription, 1);
  }
  feed(ros2::RmwTake{1, 9, 3, true});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner_name, "/topic");
  EXPECT_EQ(results.callbacks[1].owner_name, "/topic");
  EXPECT_EQ(topic(results, "/topic").subscriptions, 2u);
  EXPECT_EQ(topic(results, "/topic").received, 2u);
  EXPECT_EQ(results.unknown_messages, 1u);
}

TEST(Ros2Analysis, GivesAReusedPublisherHandleToTheNewestTopic) {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{2, 0, 1, "/old", 1})(ros2::RmwPublish{1, 9, 1});
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{2, 0, 1, "/new", 1})(ros2::RmwPublish{1, 9, 2});
  feed(ros2::RmwPublish{1, 9, 3});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/old").published, 1u);
  EXPECT_EQ(topic(results, "/new").published, 2u);
}

TEST(Ros2Analysis, CountsACallbackThatNeverEnds) {
  Feed feed;
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false});  // left by an exception
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false});  // runs when the trace ends
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].durations.count, 2u);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 10);
  EXPECT_EQ(results.callbacks[0].unfinished, 2u);
}

TEST(Ros2Analysis, IgnoresAnEndWhoseStartIsNotInTheTrace) {
  Feed feed;
  feed(ros2::CallbackEnd{0xcb});
  EXPECT_TRUE(feed.results().callbacks.empty());
}

TEST(Ros2Analysis, MeasuresACallbackWithinAnother) {
  Feed feed;
  feed(ros2::CallbackStart{1, false})(ros2::CallbackStart{2, false})(ros2::CallbackEnd{2})(ros2::CallbackEnd{1});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 30);
  EXPECT_EQ(results.callbacks[1].durations.max_ns, 10);
}

// A publisher (rmw 1) and a subscription (rmw 2, callback 0xcb) of /topic in process 71.
Feed topic_feed() {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 0, 1, "/topic", 1});
  feed(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 0, 2, "/topic", 1});
  feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
  return feed;
}

TEST(Ros2Analysis, IgnoresATakeThatTookNothing) {
  Feed feed = topic_feed();
  feed(ros2::RmwPublish{1, 9, 777});
  feed(ros2::RmwTake{2, 9, 777, false})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received, 0u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
  EXPECT_EQ(topic(results, "/topic").published_only, 1u);
}

TEST(Ros2Analysis, CountsAMessageThatNobodyReceives) {
  Feed feed = topic_feed();
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwPublish{1, 9, 778});
  feed(ros2::RmwTake{2, 9, 778, true})(ros2::CallbackStart{0xcb, false});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").published, 2u);
  EXPECT_EQ(topic(results, "/topic").published_only, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.max_ns, 30 - 10);
}

TEST(Ros2Analysis, CountsAMessageFromOutsideTheTrace) {
  Feed feed = topic_feed();
  feed(ros2::RmwTake{2, 9, 555, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received_only, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
}

TEST(Ros2Analysis, GivesATakenMessageToNoOtherCallback) {
  Feed feed = topic_feed();
  feed(ros2::RclTimerInit{3, 100})(ros2::RclcppTimerCallbackAdded{3, 0xee});
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwTake{2, 9, 777, true});
  feed(ros2::CallbackStart{0xee, false})(ros2::CallbackEnd{0xee});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
}

TEST(Ros2Analysis, TellsInternalHandlesFromUnknownOnes) {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RmwSubscriptionInit{2, {}});
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwTake{2, 9, 0, true})(ros2::RmwTake{2, 9, 0, false});
  feed(ros2::RmwPublish{4, 9, 778})(ros2::RmwTake{5, 9, 778, true});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.internal_messages, 2u);
  EXPECT_EQ(results.unknown_messages, 2u);
  EXPECT_TRUE(results.topics.empty());
}

TEST(Ros2Analysis, FindsThePublisherOfOlderEventsThroughRcl) {
  Feed feed = topic_feed();
  feed(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").published, 1u);
  EXPECT_EQ(results.unknown_messages, 0u);
}

TEST(Ros2Analysis, AttributesTheCallbackThatIsAnnouncedBeforeItsSubscriptionObject) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/ns"});
  feed(ros2::RmwSubscriptionInit{3, {}})(ros2::RclSubscriptionInit{4, 1, 3, "/topic", 1});
  // With intra-process communication: two objects, the first one's callback comes first.
  feed(ros2::RclcppSubscriptionCallbackAdded{5, 0xa})(ros2::RclcppCallbackRegister{0xa, "f"});
  feed(ros2::RclcppSubscriptionInit{4, 5})(ros2::RclcppSubscriptionInit{4, 6});
  feed(ros2::RclcppSubscriptionCallbackAdded{6, 0xb})(ros2::RclcppCallbackRegister{0xb, "f"});
  feed(ros2::CallbackStart{0xa, true})(ros2::CallbackEnd{0xa});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].node, "/ns/node");
  EXPECT_EQ(results.callbacks[0].owner_name, "/topic");
  EXPECT_EQ(results.callbacks[0].intra_process, 1u);
}

TEST(Ros2Analysis, AttributesServiceCallbacks) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/"})(ros2::RclServiceInit{3, 1, 4, "/add"});
  feed(ros2::RclcppServiceCallbackAdded{3, 0xc})(ros2::RclcppCallbackRegister{0xc, "(null)"});
  feed(ros2::CallbackStart{0xc, false})(ros2::CallbackEnd{0xc});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].owner, Owner::kService);
  EXPECT_EQ(results.callbacks[0].owner_name, "/add");
  EXPECT_EQ(results.callbacks[0].node, "/node");
  EXPECT_EQ(results.callbacks[0].symbol, "");
}

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

// Gives the endpoints of the middleware the identities that real ones have.
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

// Ping and pong with a dump of both processes' objects before the event `position`.
Ros2Results ping_pong_with_state_dump(std::size_t position) {
  const std::vector<testing::SequenceEvent> sequence = testing::ping_pong_sequence();
  Ros2Analysis analysis;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (i == position) {
      for (std::size_t known = 0; known < i; ++known) {
        const auto& [time, thread, event] = sequence[known];
        if (is_init_event(event)) analysis.on_event({sequence[i].time_ns, thread.vpid, 99}, with_gid(event));
      }
    }
    const auto& [time, thread, event] = sequence[i];
    analysis.on_event({time, thread.vpid, thread.vtid}, with_gid(event));
  }
  return analysis.finish();
}

TEST(Ros2Analysis, IsTheSameWithAStateDumpAnywhere) {
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

TEST(Ros2Analysis, NamesACallbackThatRanBeforeTheStateDump) {
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

TEST(Ros2Analysis, TellsANewTimerOfAnotherNodeFromARepeatedOne) {
  Feed feed;
  feed(ros2::RclNodeInit{7, 8, "first", "/"})(ros2::RclNodeInit{9, 8, "second", "/"});
  for (const ros2::Handle node : {7, 9}) {
    feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
        ros2::RclcppCallbackRegister{0xcb, "tick()"});
    feed(ros2::RclcppTimerLinkNode{1, node})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].node, "/first");
  EXPECT_EQ(results.callbacks[1].node, "/second");
}

TEST(Ros2Analysis, TellsANewIntraProcessSubscriptionFromARepeatedOne) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/"});
  for (const std::uint8_t identity : {1, 2}) {
    feed(ros2::RmwSubscriptionInit{3, {{identity}, 16}})(
        ros2::RclSubscriptionInit{4, 1, 3, identity == 1 ? "/first" : "/second", 1});
    feed(ros2::RclcppSubscriptionCallbackAdded{5, 0xa})(ros2::RclcppCallbackRegister{0xa, "f"});
    feed(ros2::RclcppSubscriptionInit{4, 5});
    feed(ros2::CallbackStart{0xa, true})(ros2::CallbackEnd{0xa});
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner_name, "/first");
  EXPECT_EQ(results.callbacks[1].owner_name, "/second");
}

}  // namespace
}  // namespace tracing
