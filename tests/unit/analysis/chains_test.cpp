// SPDX-License-Identifier: Apache-2.0
// Chains of callbacks, from end to end.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

// A timer in process 1 publishes /a; process 2 answers each /a with a /b; process 3 receives /b.
class Chains : public ::testing::Test {
 protected:
  Chains() { start({}); }
  void start(std::vector<ChainDefinition> chains) {
    feed.define(std::move(chains));
    feed.in(1, 1)(ros2::RclNodeInit{1, 0, "source", "/"})(ros2::RclTimerInit{3, 1'000});
    feed(ros2::RclcppTimerCallbackAdded{3, 0xe})(ros2::RclcppTimerLinkNode{3, 1});
    publisher("/a");
    feed.in(2, 2)(ros2::RclNodeInit{1, 0, "filter", "/"});
    subscription("/a");
    publisher("/b");
    feed.in(3, 3)(ros2::RclNodeInit{1, 0, "drain", "/"});
    subscription("/b");
  }
  void publisher(std::string_view topic) {
    feed(ros2::RmwPublisherInit{0x10, {}})(ros2::RclPublisherInit{0x11, 1, 0x10, topic, 10});
  }
  void subscription(std::string_view topic) {
    feed(ros2::RmwSubscriptionInit{0x20, {}})(ros2::RclSubscriptionInit{0x21, 1, 0x20, topic, 10});
    feed(ros2::RclcppSubscriptionInit{0x21, 0x22})(ros2::RclcppSubscriptionCallbackAdded{0x22, 0xcb});
  }
  void tick(std::int64_t time, std::int64_t number) {
    feed.in(1, 1).at(time)(ros2::CallbackStart{0xe, false});
    feed.at(time + 20)(ros2::RmwPublish{0x10, 9, number}).at(time + 30)(ros2::CallbackEnd{0xe});
  }
  void filter(std::int64_t time, std::int64_t number, bool answers) {
    feed.in(2, 2).at(time)(ros2::RmwTake{0x20, 9, number, true}).at(time + 5)(ros2::CallbackStart{0xcb, false});
    if (answers) {
      feed.at(time + 55)(ros2::RmwPublish{0x10, 9, number});
    }
    feed.at(time + 65)(ros2::CallbackEnd{0xcb});
  }
  void drain(std::int64_t time, std::int64_t number) {
    feed.in(3, 3).at(time)(ros2::RmwTake{0x20, 9, number, true}).at(time + 5)(ros2::CallbackStart{0xcb, false});
    feed.at(time + 25)(ros2::CallbackEnd{0xcb});
  }
  Feed feed;
};

TEST_F(Chains, AreFoundFromWhatCallbacksPublish) {
  tick(1'000, 1);
  filter(1'100, 1, true);
  drain(1'200, 1);
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.chains.size(), 1u);
  const ChainResult& chain = results.chains[0];
  ASSERT_EQ(chain.steps.size(), 3u);
  EXPECT_EQ(chain.steps[0].node, "/source");
  EXPECT_EQ(chain.steps[0].callback, "timer 1 us");
  EXPECT_EQ(chain.steps[0].topic, "");
  EXPECT_EQ(chain.steps[1].topic, "/a");
  EXPECT_EQ(chain.steps[1].until_publish.max_ns, 20);
  EXPECT_EQ(chain.steps[1].transfer.max_ns, 85);
  EXPECT_EQ(chain.steps[1].transport.max_ns + chain.steps[1].executor.max_ns + chain.steps[1].take.max_ns, 85);
  EXPECT_EQ(chain.steps[1].take.max_ns, 5);
  EXPECT_EQ(chain.steps[1].executor.count, 0u) << "the executor records no waits";
  EXPECT_EQ(chain.steps[2].node, "/drain");
  EXPECT_EQ(chain.steps[2].topic, "/b");
  EXPECT_EQ(chain.steps[2].until_publish.max_ns, 50);
  EXPECT_EQ(chain.steps[2].transfer.max_ns, 50);
  EXPECT_EQ(chain.last_callback.max_ns, 20);
  EXPECT_EQ(chain.response.max_ns, 225);
  EXPECT_EQ(chain.longest_begin_ns, 1'000);
  EXPECT_EQ(chain.longest_end_ns, 1'225);
  EXPECT_EQ(chain.age.max_ns, 225);
  EXPECT_EQ(chain.reaction.count, 0u);
  EXPECT_FALSE(chain.is_loop);
}

TEST_F(Chains, ReactLateWhenInputsGetLost) {
  tick(1'000, 1);
  filter(1'100, 1, true);
  drain(1'200, 1);
  tick(2'000, 2);
  filter(2'100, 2, false);  // this input causes nothing
  tick(3'000, 3);
  filter(3'100, 3, true);
  drain(3'200, 3);
  const ChainResult chain = feed.results().chains.at(0);
  EXPECT_EQ(chain.response.count, 2u);
  EXPECT_EQ(chain.response.max_ns, 225);
  EXPECT_EQ(chain.reaction.count, 1u);
  EXPECT_EQ(chain.reaction.max_ns, 3'225 - 1'000);
}

TEST_F(Chains, FollowMessagesThatANodeCaches) {
  // Process 3 publishes /c from a timer of its own, with the last /b that it got.
  feed.in(3, 3)(ros2::RclTimerInit{3, 500})(ros2::RclcppTimerCallbackAdded{3, 0xd})(ros2::RclcppTimerLinkNode{3, 1});
  publisher("/c");
  feed(ros2::MessageLinkPeriodicAsync{{0x21}, {0x11}});
  feed.in(4, 4)(ros2::RclNodeInit{1, 0, "end", "/"});
  subscription("/c");
  tick(1'000, 1);
  filter(1'100, 1, true);
  drain(1'200, 1);
  for (const std::int64_t time : {1'500, 2'000}) {
    feed.in(3, 3).at(time)(ros2::CallbackStart{0xd, false}).at(time + 10)(ros2::RmwPublish{0x10, 9, time});
    feed.at(time + 20)(ros2::CallbackEnd{0xd});
    feed.in(4, 4).at(time + 100)(ros2::RmwTake{0x20, 9, time, true})(ros2::CallbackStart{0xcb, false});
    feed.at(time + 200)(ros2::CallbackEnd{0xcb});
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.chains.size(), 2u);
  const ChainResult& cached = results.chains[0];
  ASSERT_EQ(cached.steps.size(), 4u);
  EXPECT_EQ(cached.steps[2].callback, "subscription /b");
  EXPECT_EQ(cached.steps[3].topic, "/c");
  EXPECT_EQ(cached.steps[3].until_publish.min_ns, 1'510 - 1'205);
  EXPECT_EQ(cached.response.count, 1u);
  EXPECT_EQ(cached.response.max_ns, 1'700 - 1'000);
  EXPECT_EQ(cached.age.max_ns, 2'200 - 1'000);
  const ChainResult& of_timer = results.chains[1];
  EXPECT_EQ(of_timer.steps.size(), 2u);
  EXPECT_EQ(of_timer.response.count, 2u);
  EXPECT_EQ(of_timer.response.max_ns, 200);
}

TEST_F(Chains, FollowEachOfManyCachedMessages) {
  constexpr ros2::Handle kInputs = 20;
  std::vector<ros2::Handle> inputs;
  for (ros2::Handle i = 0; i < kInputs; ++i) {
    const std::string topic = "/input_" + std::to_string(i);
    const ros2::Handle at = 0x100 * (i + 1);
    feed.in(3, 3)(ros2::RmwSubscriptionInit{at, {}})(ros2::RclSubscriptionInit{at + 1, 1, at, topic, 10});
    feed(ros2::RclcppSubscriptionInit{at + 1, at + 2})(ros2::RclcppSubscriptionCallbackAdded{at + 2, at + 3});
    inputs.push_back(at + 1);
    const auto source = static_cast<std::int64_t>(10 + i);
    feed.in(source, source)(ros2::RclNodeInit{1, 0, "source" + std::to_string(i), "/"})(ros2::RclTimerInit{3, 1'000});
    feed(ros2::RclcppTimerCallbackAdded{3, 0xe})(ros2::RclcppTimerLinkNode{3, 1});
    publisher(topic);
  }
  feed.in(3, 3)(ros2::RclTimerInit{3, 500})(ros2::RclcppTimerCallbackAdded{3, 0xd})(ros2::RclcppTimerLinkNode{3, 1});
  publisher("/c");
  feed(ros2::MessageLinkPeriodicAsync{inputs, {0x11}});
  feed.in(4, 4)(ros2::RclNodeInit{1, 0, "end", "/"});
  subscription("/c");
  for (std::int64_t round = 1; round <= 3; ++round) {
    for (ros2::Handle i = 0; i < kInputs; ++i) {
      const std::int64_t time = 10'000 * round + 100 * static_cast<std::int64_t>(i);
      const auto source = static_cast<std::int64_t>(10 + i);
      const ros2::Handle at = 0x100 * (i + 1);
      feed.in(source, source).at(time)(ros2::CallbackStart{0xe, false});
      feed.at(time + 1)(ros2::RmwPublish{0x10, 9, time}).at(time + 2)(ros2::CallbackEnd{0xe});
      feed.in(3, 3).at(time + 10)(ros2::RmwTake{at, 9, time, true})(ros2::CallbackStart{at + 3, false});
      feed.at(time + 20)(ros2::CallbackEnd{at + 3});
    }
    const std::int64_t time = 10'000 * round + 5'000;
    feed.in(3, 3).at(time)(ros2::CallbackStart{0xd, false}).at(time + 10)(ros2::RmwPublish{0x10, 9, time});
    feed.at(time + 20)(ros2::CallbackEnd{0xd});
    feed.in(4, 4).at(time + 100)(ros2::RmwTake{0x20, 9, time, true})(ros2::CallbackStart{0xcb, false});
    feed.at(time + 200)(ros2::CallbackEnd{0xcb});
  }
  const Ros2Results results = feed.results();
  std::size_t from_sources = 0;
  for (const ChainResult& chain : results.chains) {
    from_sources += chain.steps.size() == 3 && chain.response.count == 3 ? 1 : 0;
  }
  EXPECT_EQ(from_sources, kInputs);
}

TEST_F(Chains, EndWhereALoopBegins) {
  feed.in(3, 3);
  publisher("/a");
  tick(1'000, 1);
  filter(1'100, 1, true);
  feed.in(3, 3).at(1'200)(ros2::RmwTake{0x20, 9, 1, true}).at(1'205)(ros2::CallbackStart{0xcb, false});
  feed.at(1'215)(ros2::RmwPublish{0x10, 9, 2}).at(1'225)(ros2::CallbackEnd{0xcb});
  filter(1'300, 2, true);
  drain(1'400, 2);
  const Ros2Results results = feed.results();
  const auto loop = std::find_if(results.chains.begin(), results.chains.end(),
                                 [](const ChainResult& chain) { return chain.is_loop; });
  ASSERT_NE(loop, results.chains.end());
  EXPECT_EQ(loop->steps.size(), 4u);
  EXPECT_EQ(loop->steps[3].node, "/filter");
  EXPECT_EQ(loop->response.max_ns, 1'365 - 1'000);
}

std::string shape(const ChainResult& chain) {
  std::string nodes;
  for (const ChainResult::Step& step : chain.steps) {
    nodes += step.node + " ";
  }
  return chain.name + ": " + nodes + std::to_string(chain.response.max_ns);
}

std::vector<std::string> shapes(const Ros2Results& results) {
  std::vector<std::string> all;
  for (const ChainResult& chain : results.chains) {
    all.push_back(shape(chain));
  }
  return all;
}

using Shapes = std::vector<std::string>;

TEST_F(Chains, WithANameAndABudgetAreComparedWithIt) {
  start({{"whole", {"/source", "/drain"}, 225}, {"strict", {"/sou*", "/filter", "/drain"}, 200}});
  for (const std::int64_t time : {1'000, 2'000}) {
    tick(time, time);
    filter(time + 100, time, true);
    drain(time + 200, time);
  }
  const Ros2Results results = feed.results();
  EXPECT_EQ(shapes(results), (Shapes{"whole: /source /filter /drain 225", "strict: /source /filter /drain 225"}));
  EXPECT_EQ(results.chains[0].budget_ns, 225);
  EXPECT_EQ(results.chains[0].over_budget, 0u);
  EXPECT_EQ(results.chains[1].over_budget, 2u);
  EXPECT_TRUE(results.unseen_chains.empty());
}

TEST_F(Chains, WithANameMayBePartsOfLongerOnes) {
  start({{"end", {"/filter", "/drain"}, {}}, {"begin", {"/source", "/filter"}, {}}});
  tick(1'000, 1);
  filter(1'100, 1, true);
  drain(1'200, 1);
  const Ros2Results results = feed.results();
  EXPECT_EQ(shapes(results),
            (Shapes{"end: /filter /drain 120", "begin: /source /filter 165", ": /source /filter /drain 225"}));
}

TEST_F(Chains, WithANameThatNobodyWentThroughAreNamed) {
  start({{"wrong order", {"/drain", "/source"}, {}}, {"other", {"/source", "/other", "/drain"}, {}}});
  tick(1'000, 1);
  filter(1'100, 1, true);
  drain(1'200, 1);
  const Ros2Results results = feed.results();
  EXPECT_EQ(shapes(results), (Shapes{": /source /filter /drain 225"}));
  EXPECT_EQ(results.unseen_chains, (Shapes{"wrong order", "other"}));
}

TEST_F(Chains, WithANameBeginOnlyThereEvenIfSomeOfTheirInputsHaveNoCause) {
  start({{"end", {"/filter", "/drain"}, {}}});
  filter(1'100, 1, true);  // its message is not in the trace
  drain(1'200, 1);
  tick(2'000, 2);
  filter(2'100, 2, true);
  drain(2'200, 2);
  const Ros2Results results = feed.results();
  EXPECT_EQ(shapes(results), (Shapes{"end: /filter /drain 120", ": /source /filter /drain 225"}));
  EXPECT_EQ(results.chains[0].response.count, 2u);
}

}  // namespace
}  // namespace tracing
