// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/simulation.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;
using testing::SmallSystem;
using Times = std::vector<std::int64_t>;

Times callback(const Figures& figures, const std::string& name) {
  const auto found = figures.find({FigureKind::kCallback, name});
  return found == figures.end() ? Times() : found->second;
}

Times hop(const Figures& figures, const std::string& from, const std::string& to) {
  const auto found = figures.find({FigureKind::kHop, hop_name(from, to)});
  return found == figures.end() ? Times() : found->second;
}

TEST(Simulation, AMessageTakesItsDelayToAnExecutorThatWaits) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 10 * kMs, 2 * kMs);
  const Index topic = small.publish(timer, "/a", 0.5);
  small.add_subscription("sub", topic, 3 * kMs, kMs / 2, small.add_process("/two"));
  small.system.cpus = 2;
  const Figures figures = Simulation(small.system).run(25 * kMs);
  EXPECT_EQ(callback(figures, "timer"), (Times{2 * kMs, 2 * kMs, 2 * kMs}));
  EXPECT_EQ(hop(figures, "/one", "sub"), (Times{kMs / 2, kMs / 2, kMs / 2}));
  EXPECT_EQ(callback(figures, "sub"), (Times{3 * kMs, 3 * kMs, 3 * kMs}));
}

// Both are due at 0, 10, 20 …: the second one waits for the first one, and its message for both.
TEST(Simulation, TwoCallbacksOfASingleThreadedExecutorFollowOneAnother) {
  SmallSystem small;
  const Index first = small.add_timer("first", 10 * kMs, 4 * kMs);
  small.add_timer("second", 10 * kMs, 3 * kMs);
  const Index topic = small.publish(first, "/a", 0.25);
  small.add_subscription("sub", topic, kMs, 0);
  small.system.cpus = 4;
  const Figures figures = Simulation(small.system).run(9 * kMs);
  // Published at 1 ms; the wait of time 0 has found both timers; the next wait, at 7 ms, finds the message.
  EXPECT_EQ(hop(figures, "/one", "sub"), Times{6 * kMs});
  EXPECT_EQ(callback(figures, "second"), Times{3 * kMs});
}

TEST(Simulation, AMultiThreadedExecutorRunsCallbacksOfOneGroupOneAfterTheOther) {
  SmallSystem small;
  const Index first = small.add_timer("first", 100 * kMs, 4 * kMs);
  small.system.executors[0] = {0, Executor::Kind::kMulti, 2, 0};
  const Index topic = small.publish(first, "/a", 0.25);
  small.add_subscription("sub", topic, kMs, 0);
  small.system.cpus = 2;
  const Figures one_group = Simulation(small.system).run(20 * kMs);
  EXPECT_EQ(hop(one_group, "/one", "sub"), Times{3 * kMs});

  small.system.groups.push_back({0, 0, false});
  small.system.callbacks[1].group = 1;
  const Figures two_groups = Simulation(small.system).run(20 * kMs);
  EXPECT_EQ(hop(two_groups, "/one", "sub"), Times{0});

  small.system.callbacks[1].group = 0;
  small.system.groups[0].reentrant = true;
  const Figures reentrant = Simulation(small.system).run(20 * kMs);
  EXPECT_EQ(hop(reentrant, "/one", "sub"), Times{0});
}

TEST(Simulation, AMultiThreadedExecutorWithoutAFreeThreadLetsMessagesWait) {
  SmallSystem small;
  const Index first = small.add_timer("first", 100 * kMs, 4 * kMs);
  small.add_timer("second", 100 * kMs, 6 * kMs, 1);
  small.system.executors[0] = {0, Executor::Kind::kMulti, 2, 0};
  small.system.groups.push_back({0, 0, false});
  small.system.groups.push_back({0, 0, false});
  const Index topic = small.publish(first, "/a", 0.25);
  small.add_subscription("sub", topic, kMs, 0, 2);
  small.system.cpus = 4;
  EXPECT_EQ(hop(Simulation(small.system).run(20 * kMs), "/one", "sub"), Times{3 * kMs});
  small.system.executors[0].threads = 3;
  EXPECT_EQ(hop(Simulation(small.system).run(20 * kMs), "/one", "sub"), Times{0});
}

TEST(Simulation, ProcessesShareOneProcessorAndHaveTwoForThemselves) {
  SmallSystem small;
  small.add_timer("one", 100 * kMs, 6 * kMs);
  small.add_timer("two", 100 * kMs, 6 * kMs, small.add_process("/two"));
  // In turns of 3 ms: the first one ends at 9 ms, the second one began at 3 ms and ends at 12 ms.
  const Figures shared = Simulation(small.system).run(50 * kMs);
  EXPECT_EQ(callback(shared, "one"), Times{9 * kMs});
  EXPECT_EQ(callback(shared, "two"), Times{9 * kMs});
  small.system.cpus = 2;
  const Figures apart = Simulation(small.system).run(50 * kMs);
  EXPECT_EQ(callback(apart, "one"), Times{6 * kMs});
  EXPECT_EQ(callback(apart, "two"), Times{6 * kMs});
}

TEST(Simulation, AHigherPriorityPreempts) {
  SmallSystem small;
  small.add_timer("ordinary", 100 * kMs, 6 * kMs);
  const Index urgent = small.add_timer("urgent", 100 * kMs, 2 * kMs, small.add_process("/two"));
  small.system.callbacks[urgent].phase_ns = kMs;
  small.system.executors[1].priority = 50;
  const Figures figures = Simulation(small.system).run(50 * kMs);
  EXPECT_EQ(callback(figures, "urgent"), Times{2 * kMs});
  EXPECT_EQ(callback(figures, "ordinary"), Times{8 * kMs});
}

TEST(Simulation, AFullQueueLosesTheOldestMessage) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 10 * kMs, 0);
  const Index topic = small.publish(timer, "/a", 0);
  const Index group = small.add_process("/two");
  const Index sub = small.add_subscription("sub", topic, 35 * kMs, 0, group);
  small.system.callbacks[sub].qos.depth = 1;
  small.system.cpus = 2;
  // Begins at 0 and 35 (with the message of 30) and 70 (with that of 70 or the one before).
  const Times ways = hop(Simulation(small.system).run(69 * kMs), "/one", "sub");
  EXPECT_EQ(ways, (Times{0, 5 * kMs}));
}

TEST(Simulation, ATimerThatIsLateLeavesOutPeriods) {
  SmallSystem small;
  small.add_timer("timer", 10 * kMs, 25 * kMs);
  // At 0, 25 (due at 10; then next at 30), 50 (due at 30, next at 50 …).
  EXPECT_EQ(callback(Simulation(small.system).run(80 * kMs), "timer").size(), 3u);
}

TEST(Simulation, ATimerIsLateIfItsThreadHasToWakeUp) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 100 * kMs, kMs);
  small.system.callbacks[timer].delays.values = {4 * kMs};
  const auto ends_until = [&](std::int64_t time_ns) {
    return callback(Simulation(small.system).run(time_ns), "timer").size();
  };
  EXPECT_EQ(ends_until(5 * kMs - 1), 0u);
  EXPECT_EQ(ends_until(5 * kMs), 1u);
  // A thread that is busy until 5 ms finds at 5 ms what is due at 3 ms.
  const Index other = small.add_timer("other", 100 * kMs, 5 * kMs);
  small.system.callbacks[timer].phase_ns = 3 * kMs;
  EXPECT_EQ(ends_until(6 * kMs - 1), 0u);
  EXPECT_EQ(ends_until(6 * kMs), 1u);
  small.system.callbacks[other].run_times.values = {0};
  EXPECT_EQ(ends_until(8 * kMs - 1), 0u);
  EXPECT_EQ(ends_until(8 * kMs), 1u);
}

TEST(Simulation, MessagesOfTheSameProcessTakeTheirOwnTime) {
  SmallSystem small;
  const Index near = small.add_timer("near", 10 * kMs, 0);
  const Index topic = small.publish(near, "/a", 0);
  const Index far = small.add_timer("far", 10 * kMs, 0, small.add_process("/two"));
  small.system.callbacks[far].phase_ns = 5 * kMs;
  small.system.publishers.push_back({1, topic, {}});
  small.system.callbacks[far].outputs.push_back(small.system.callbacks[near].outputs[0]);
  small.system.callbacks[far].outputs[0].publisher = 1;
  const Index sub = small.add_subscription("sub", topic, 0, 3 * kMs);
  small.system.callbacks[sub].near_delays.values = {kMs};
  small.system.cpus = 2;
  const Figures figures = Simulation(small.system).run(9 * kMs);
  EXPECT_EQ(hop(figures, "/one", "sub"), Times{kMs});
  EXPECT_EQ(hop(figures, "/two", "sub"), Times{3 * kMs});
}

TEST(Simulation, AnEventsExecutorTakesWhatComesInItsOrder) {
  SmallSystem small;
  const Index sender = small.add_timer("sender", 100 * kMs, 2 * kMs, small.add_process("/two"));
  const Index topic = small.publish(sender, "/a", 0.5);
  small.add_timer("first", 3 * kMs, 2 * kMs);
  small.add_subscription("sub", topic, kMs, 0);
  small.system.cpus = 2;
  // The message comes at 1 ms, while the timer runs until 2 ms.
  small.system.executors[0].kind = Executor::Kind::kEvents;
  EXPECT_EQ(hop(Simulation(small.system).run(20 * kMs), "/two", "sub"), Times{kMs});
}

TEST(Simulation, ACallGoesToTheServiceAndBack) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 100 * kMs, kMs);
  small.system.clients.push_back({0, "/add"});
  Output request;
  request.client = 0;
  small.system.callbacks[timer].outputs.push_back(request);
  const Index group = small.add_process("/server");
  Callback service;
  service.kind = Callback::Kind::kService;
  service.name = "service";
  service.service = "/add";
  service.group = group;
  service.run_times.values = {2 * kMs};
  service.delays.values = {kMs / 2};
  small.system.callbacks.push_back(service);
  Callback client;
  client.kind = Callback::Kind::kClient;
  client.name = "client";
  client.client = 0;
  client.group = 0;
  client.run_times.values = {kMs};
  client.delays.values = {kMs / 4};
  small.system.callbacks.push_back(client);
  small.system.cpus = 2;
  const Figures figures = Simulation(small.system).run(50 * kMs);
  EXPECT_EQ(figures.at({FigureKind::kCall, "/one calls /add"}), Times{2 * kMs + kMs / 2 + kMs / 4});
  EXPECT_EQ(callback(figures, "client"), Times{kMs});
}

TEST(Simulation, ACallbackThatSleepsLeavesTheProcessorToOthers) {
  SmallSystem small;
  const Index sleeper = small.add_timer("sleeper", 100 * kMs, 10 * kMs);
  small.system.callbacks[sleeper].blocked = 0.8;
  const Index other = small.add_timer("other", 100 * kMs, 5 * kMs, small.add_process("/two"));
  small.system.callbacks[other].phase_ns = 3 * kMs;
  const Figures figures = Simulation(small.system).run(50 * kMs);
  EXPECT_EQ(callback(figures, "sleeper"), Times{10 * kMs});
  EXPECT_EQ(callback(figures, "other"), Times{5 * kMs});
}

TEST(Simulation, HasTheSameResultForTheSameSeed) {
  SmallSystem small;
  const Index timer = small.add_timer("timer", 10 * kMs, 0);
  for (std::int64_t time = 1; time <= 20; ++time) {
    small.system.callbacks[timer].run_times.values.push_back(time * kMs / 10);
  }
  const Figures once = Simulation(small.system).run(300 * kMs);
  EXPECT_EQ(once, Simulation(small.system).run(300 * kMs));
  small.system.seed = 2;
  EXPECT_NE(once, Simulation(small.system).run(300 * kMs));
}

}  // namespace
}  // namespace tracing::twin
