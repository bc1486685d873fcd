// SPDX-License-Identifier: Apache-2.0
// What the process that was ready last had to wait for.
#include "tracing/model/analysis/critical_start.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tracing {
namespace {

using ::testing::ElementsAre;

StartedProcess process(const std::string& name, std::int64_t spawn_ns, std::int64_t exec_ns,
                       std::optional<std::int64_t> init_after, std::optional<std::int64_t> node_after,
                       std::optional<std::int64_t> ready_after) {
  StartedProcess started;
  started.name = name;
  started.start.process = name + "-1";
  started.start.spawn_ns = spawn_ns;
  started.start.exec_ns = exec_ns;
  started.start.init_after_ns = init_after;
  started.start.node_after_ns = node_after;
  started.start.ready_after_ns = ready_after;
  return started;
}

// "talker-1: until ready 5-9"
std::vector<std::string> texts(const std::optional<StartupResult>& startup) {
  std::vector<std::string> list;
  for (const StartStep& step : startup.value_or(StartupResult()).critical_path) {
    list.push_back((step.process.empty() ? "" : step.process + ": ") + step.what + " " + std::to_string(step.begin_ns) +
                   "-" + std::to_string(step.end_ns));
  }
  return list;
}

const std::vector<LauncherStep> kSteps{
    {"load a.launch.xml", 0, 10}, {"visit", 12, 20}, {"include b.launch.xml", 14, 16}};

TEST(CriticalStart, FollowsTheProcessThatWasReadyLast) {
  const auto startup =
      critical_start({process("talker", 25, 30, 40, 50, 60), process("slow", 31, 35, 45, 60, 90)}, {}, kSteps);
  EXPECT_THAT(texts(startup),
              ElementsAre("load a.launch.xml 0-10", "other things 10-12", "visit 12-20", "other things 20-31",
                          "slow-1: started by the launcher 31-35", "slow-1: until rcl_init 35-80",
                          "slow-1: until its first node 80-95", "slow-1: until ready 95-125"));
  EXPECT_EQ(startup->begin_ns, 0);
  EXPECT_EQ(startup->ready_ns, 125);
}

TEST(CriticalStart, GoesOnWithTheProcessThatAnotherOneWaitedFor) {
  const auto startup = critical_start(
      {process("map", 25, 30, 40, 60, 500), process("planner", 120, 130, 10, 20, 470)},
      {{"planner", "'map' has started", 30}, {"planner", "'map' has written 'loaded'", 110}, {"other", "'x'", 115}},
      kSteps);
  EXPECT_THAT(texts(startup),
              ElementsAre("load a.launch.xml 0-10", "other things 10-12", "visit 12-20", "other things 20-25",
                          "map-1: started by the launcher 25-30", "map-1: until rcl_init 30-70",
                          "map-1: until its first node 70-90", "map-1: until 'map' has written 'loaded' 90-110",
                          "until planner-1 was started 110-120", "planner-1: started by the launcher 120-130",
                          "planner-1: until rcl_init 130-140", "planner-1: until its first node 140-150",
                          "planner-1: until ready 150-600"));
}

TEST(CriticalStart, KnowsConditionsOfTheGraph) {
  const auto startup = critical_start({process("planner", 120, 130, {}, 20, 30)},
                                      {{"planner", "topic /map has a publisher", 100}}, kSteps);
  EXPECT_THAT(texts(startup),
              ElementsAre("load a.launch.xml 0-10", "other things 10-12", "visit 12-20",
                          "until topic /map has a publisher 20-100", "until planner-1 was started 100-120",
                          "planner-1: started by the launcher 120-130", "planner-1: until its first node 130-150",
                          "planner-1: until ready 150-160"));
}

TEST(CriticalStart, EndsWhenTwoProcessesWaitForEachOther) {
  const auto startup = critical_start({process("a", 5, 10, {}, 10, 20), process("b", 20, 25, {}, 5, 30)},
                                      {{"b", "'a' has started", 18}, {"a", "'b' has started", 4}}, {});
  EXPECT_THAT(texts(startup), ElementsAre("until a-1 was started 4-5", "a-1: started by the launcher 5-10",
                                          "a-1: until 'a' has started 10-18", "until b-1 was started 18-20",
                                          "b-1: started by the launcher 20-25", "b-1: until its first node 25-30",
                                          "b-1: until ready 30-55"));
}

TEST(CriticalStart, IsUnknownWithoutAProcessThatWasReady) {
  EXPECT_EQ(critical_start({process("talker", 25, 30, 40, 50, {})}, {}, kSteps), std::nullopt);
}

}  // namespace
}  // namespace tracing
