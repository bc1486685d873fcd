// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using ChainResults = testing::SummaryObjects;

TEST_F(ChainResults, ListTheStepsFromTheFirstOne) {
  ChainTracker chains;
  const Publication publication{.number = 1, .topic = 0, .publisher = 0, .thread = {1, 1}, .published_ns = 110};
  chains.on_callback_begin({.thread = {1, 1}, .callback = 1, .begin_ns = 100, .end_ns = 100});
  chains.on_publication(publication);
  chains.on_callback({.thread = {1, 1}, .callback = 1, .begin_ns = 100, .end_ns = 120});
  chains.on_callback_begin({.thread = {1, 2}, .callback = 0, .begin_ns = 150, .end_ns = 150});
  chains.on_message({.publication = publication,
                     .subscription = 0,
                     .taking_thread = {1, 2},
                     .taken_ns = 140,
                     .callback = 0,
                     .callback_begin_ns = 150});
  chains.on_callback({.thread = {1, 2}, .callback = 0, .begin_ns = 150, .end_ns = 170});
  chains.finish();
  Ros2Results results;
  add_chain_results(subjects, chains, MessageMatcher(), results);
  ASSERT_EQ(results.chains.size(), 1u);
  const ChainResult& chain = results.chains[0];
  ASSERT_EQ(chain.steps.size(), 2u);
  EXPECT_EQ(chain.steps[0].callback, "timer 100 ns");
  EXPECT_EQ(chain.steps[0].topic, "");
  EXPECT_EQ(chain.steps[1].callback, "subscription /topic");
  EXPECT_EQ(chain.steps[1].topic, "/topic");
  EXPECT_EQ(chain.steps[1].callback_id, 0u);
  EXPECT_EQ(chain.response.max_ns, 70);
  EXPECT_TRUE(chain.doubtful);
  EXPECT_TRUE(results.has_all_chains);
}

TEST_F(ChainResults, NameTheChainsThatWereNeverGoneThrough) {
  ChainTracker chains;
  ChainDefinition definition;
  definition.name = "brake";
  chains.define(model, {definition});
  chains.finish();
  Ros2Results results;
  add_chain_results(subjects, chains, MessageMatcher(), results);
  EXPECT_TRUE(results.chains.empty());
  EXPECT_EQ(results.unseen_chains, std::vector<std::string>{"brake"});
}

}  // namespace
}  // namespace tracing
