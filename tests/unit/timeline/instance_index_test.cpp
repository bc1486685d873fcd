// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/instance_index.hpp"

#include <gtest/gtest.h>

namespace tracing::timeline {
namespace {

Instance instance(Index thread, std::int64_t start_ns, std::int64_t end_ns) {
  return {.start_ns = start_ns, .end_ns = end_ns, .thread = thread};
}

TEST(InstanceIndex, FindsTheInnermostInstanceThatRuns) {
  const std::vector<Instance> instances = {instance(0, 10, 100), instance(1, 15, 16), instance(0, 20, 30),
                                           instance(0, 40, 50)};
  const InstanceIndex index(instances, 2);
  EXPECT_EQ(index.running(0, 9), kNone);
  EXPECT_EQ(index.running(0, 10), 0u);
  EXPECT_EQ(index.running(0, 25), 2u);
  EXPECT_EQ(index.running(0, 35), 0u) << "between the two that run within it";
  EXPECT_EQ(index.running(0, 50), 3u);
  EXPECT_EQ(index.running(0, 60), 0u);
  EXPECT_EQ(index.running(0, 101), kNone);
  EXPECT_EQ(index.running(1, 20), kNone) << "of another thread";
}

TEST(InstanceIndex, FindsTheInstanceThatBegins) {
  const std::vector<Instance> instances = {instance(0, 10, 20), instance(1, 30, 40)};
  const InstanceIndex index(instances, 2);
  EXPECT_EQ(index.begun(0, 10), 0u);
  EXPECT_EQ(index.begun(0, 11), kNone);
  EXPECT_EQ(index.begun(0, 30), kNone);
  EXPECT_EQ(index.begun(1, 30), 1u);
}

}  // namespace
}  // namespace tracing::timeline
