// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/traced_example/traced_example.hpp"
#include "tests/unit/tables/rows_of.hpp"
#include "tracing/model/timeline/time_window.hpp"

namespace tracing {
namespace {

using ::testing::ElementsAre;
using testing::rows_of;
using ::testing::SizeIs;

TEST(ChainTables, HaveEachTimeThatSomethingWentThroughAChain) {
  const TracedSystem system = testing::traced_example(100);
  ASSERT_THAT(rows_of(system, "chains", {"id", "response_count", "response_max_ns"}), ElementsAre("0|98|4450000"));
  EXPECT_THAT(rows_of(system, "chain_steps", {"chain", "step", "node", "callback", "topic"}),
              ElementsAre("0|0|/sensor|timer 10 ms|-", "0|1|/filter|subscription /scan|/scan",
                          "0|2|/display|subscription /points|/points"));
  const std::vector<std::string> instances =
      rows_of(system, "chain_instances", {"id", "chain", "begin_ns", "end_ns", "first"});
  ASSERT_THAT(instances, SizeIs(98));
  EXPECT_EQ(instances[0], "0|0|1767225600020000000|1767225600020850000|1");
}

TEST(ChainTables, HaveTheHopsOfEachPassage) {
  const TracedSystem system = testing::traced_example(2);
  EXPECT_THAT(rows_of(system, "chain_hops",
                      {"chain_instance", "step", "callback_instance", "message", "duration_ns", "until_publish_ns",
                       "transfer_ns", "executor_ns", "take_ns"}),
              ElementsAre("0|0|0|-|200000|-|-|-|-", "0|1|1|0|400000|100000|200000|-|50000",
                          "0|2|2|1|50000|300000|200000|-|50000", "1|0|3|-|200000|-|-|-|-",
                          "1|1|4|2|400000|100000|200000|2000|50000", "1|2|5|3|50000|300000|200000|2000|50000"));
}

TEST(ChainTables, OfAPartHaveThePassagesThatBeginInIt) {
  TracedSystem system = testing::traced_example(10);
  timeline::keep_window(system.timeline, testing::kExampleFirstCycle + 2 * testing::kExamplePeriod,
                        testing::kExampleFirstCycle + 4 * testing::kExamplePeriod);
  EXPECT_THAT(rows_of(system, "chain_instances", {"begin_ns"}),
              ElementsAre("1767225600040000000", "1767225600050000000"));
  EXPECT_THAT(rows_of(system, "chain_hops", {"chain_instance", "step", "callback_instance", "message"}),
              ElementsAre("0|0|0|-", "0|1|1|0", "0|2|2|1", "1|0|3|-", "1|1|4|2", "1|2|5|3"));
  EXPECT_THAT(rows_of(system, "messages", {"rcl_ns"}), SizeIs(4));
}

}  // namespace
}  // namespace tracing
