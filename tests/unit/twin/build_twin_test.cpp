// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/build_twin.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/unit/twin/small_system.hpp"
#include "tests/unit/twin/timeline_by_hand.hpp"
#include "tracing/model/twin/figures.hpp"
#include "tracing/model/twin/simulation.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;

// The example of example_system.hpp, read from its files.
class ExampleTwin : public ::testing::Test {
 protected:
  static Recording read() {
    const ::tracing::testing::TemporaryDirectory directory;
    ::tracing::testing::write_example_system(directory.path() / "trace", 100);
    return read_recording(directory.path() / "trace");
  }
  const Callback& callback(const std::string& name) const {
    const auto found = std::find_if(twin_.callbacks.begin(), twin_.callbacks.end(),
                                    [&](const Callback& callback) { return callback.name == name; });
    EXPECT_NE(found, twin_.callbacks.end()) << name;
    return *found;
  }

  const Recording recording_ = read();
  const System twin_ = build_twin(recording_, {.cpus = 2});
};

TEST_F(ExampleTwin, HasTheGraph) {
  ASSERT_EQ(twin_.processes.size(), 3u);
  ASSERT_EQ(twin_.executors.size(), 3u);
  ASSERT_EQ(twin_.nodes.size(), 3u);
  EXPECT_EQ(twin_.nodes[0].name, "/sensor");
  const Callback& timer = callback("/sensor, timer 10 ms");
  EXPECT_EQ(timer.period_ns, 10 * kMs);
  EXPECT_EQ(timer.runs, 100u);
  EXPECT_EQ(timer.run_times.quantile(0.5), 200'000);
  ASSERT_EQ(timer.outputs.size(), 1u);
  const Publisher& scan = twin_.publishers[timer.outputs[0].publisher];
  EXPECT_EQ(twin_.topics[scan.topic].name, "/scan");
  EXPECT_EQ(timer.outputs[0].rule, Output::Rule::kAlways);
  EXPECT_DOUBLE_EQ(timer.outputs[0].sent, 0.5);
  const Callback& filter = callback("/filter, subscription /scan");
  EXPECT_EQ(filter.topic, scan.topic);
  EXPECT_EQ(filter.run_times.quantile(0.5), 400'000);
  EXPECT_EQ(filter.run_times.quantile(0.99), 4 * kMs);
  EXPECT_EQ(filter.delays.quantile(0.5), 200'000);
}

TEST_F(ExampleTwin, SimulatedAsItWasHasItsFigures) {
  const Figures recorded = figures_of(recording_, twin_);
  const Figures simulated = Simulation(twin_).run(twin_.duration_ns);
  EXPECT_EQ(recorded.size(), 5u);
  for (const auto& [key, values] : recorded) {
    ASSERT_TRUE(simulated.contains(key)) << key.name;
    const FigureSummary was = summary_of(values);
    const FigureSummary is = summary_of(simulated.at(key));
    EXPECT_NEAR(static_cast<double>(is.median_ns), static_cast<double>(was.median_ns), 0.05 * was.median_ns)
        << key.name;
    EXPECT_NEAR(static_cast<double>(is.p99_ns), static_cast<double>(was.p99_ns), 0.05 * was.p99_ns) << key.name;
  }
}

TEST_F(ExampleTwin, NamesWhatItLacks) {
  std::string all;
  for (const std::string& sentence : twin_.missing) {
    all += sentence + "\n";
  }
  EXPECT_NE(all.find("/display has lifecycle states"), std::string::npos) << all;
  EXPECT_NE(all.find("does not tell the sizes of messages"), std::string::npos);
  EXPECT_NE(all.find("no events of the kernel's scheduler"), std::string::npos);
}

// Timers are made one after the other, and first called when the executor begins: at the same time, and most of them
// late.
TEST(BuildTwin, TimersKeepTheirDistanceAlthoughTheirFirstCallsAreLate) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index first = hand.add_timer(node);
  const timeline::Index second = hand.add_timer(node);
  hand.run(first, thread, 90, 91);
  hand.run(second, thread, 95, 96);
  for (const std::int64_t period : {100, 200, 300, 400, 500, 600}) {
    const std::int64_t late = period == 300 ? 5 : 0;
    hand.run(first, thread, period + 20 + late, period + 21 + late);
    hand.run(second, thread, period + 60 + 2 * late, period + 61 + 2 * late);
  }
  const System twin = build_twin(hand.recording, {});
  ASSERT_EQ(twin.callbacks.size(), 2u);
  EXPECT_EQ(twin.callbacks[0].phase_ns, 0);
  EXPECT_EQ(twin.callbacks[1].phase_ns, 40);
  EXPECT_EQ(twin.active_ns, 661 - 20);  // without what the process does before
}

// A thread that sleeps is called late, one that is busy with another callback finds the timer at once. One call in 200
// came earlier: the timer was set anew.
TEST(BuildTwin, ATimerIsDueAtItsEarliestCall) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index other = hand.add_timer(node, 20'000);
  const timeline::Index timer = hand.add_timer(node, 10'000);
  for (std::int64_t call = 0; call < 200; ++call) {
    const std::int64_t due = 5'000 + call * 10'000;
    if (call % 2 == 0) {
      hand.run(other, thread, due - 3'000, due - 2'990);
    }
    const std::int64_t late = call == 100 ? -2'000 : call % 20 == 5 ? 0 : 60;
    hand.run(timer, thread, due + late, due + late + 10);
  }
  const System twin = build_twin(hand.recording, {});
  ASSERT_EQ(twin.callbacks.size(), 2u);
  EXPECT_EQ(twin.callbacks[0].phase_ns, 0);
  EXPECT_EQ(twin.callbacks[1].phase_ns, 3'000);
  EXPECT_EQ(twin.callbacks[1].delays.quantile(0.5), 60);
}

// What the thread finds due at the end of a callback was due before it ended.
TEST(BuildTwin, ATimerThatWaitsForACallbackIsDueBeforeTheCallbackEnds) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index other = hand.add_timer(node, 100'000'000);
  const timeline::Index timer = hand.add_timer(node, 10'000'000);
  for (std::int64_t call = 0; call < 40; ++call) {
    const std::int64_t due = 5'000'000 + call * 10'000'000;
    if (call % 10 == 0) {
      hand.run(other, thread, due - 200'000, due + 3'000);
      hand.run(timer, thread, due + 10'000, due + 20'000);
    } else {
      hand.run(timer, thread, due + 60'000, due + 70'000);
    }
  }
  const System twin = build_twin(hand.recording, {});
  ASSERT_EQ(twin.callbacks.size(), 2u);
  EXPECT_EQ(twin.callbacks[1].phase_ns, 200'000 + 3'000 - 1'000);
}

// A node that publishes at these times, outside of callbacks.
testing::HandRecording loop_of(const std::vector<std::int64_t>& times, std::int64_t end_ns) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/loop");
  hand.add_thread(1);
  hand.recording.timeline.topics.push_back("/a");
  hand.recording.timeline.publishers.push_back({node, 0});
  hand.recording.publishers.push_back({3, true, false});
  for (const std::int64_t time : times) {
    timeline::Message message;
    message.called_ns = message.published_ns = time;
    message.topic = 0;
    message.publisher = 0;
    message.publishing_thread = 0;
    hand.recording.timeline.messages.push_back(message);
  }
  hand.recording.timeline.end_ns = end_ns;
  return hand;
}

TEST(BuildTwin, ATimerStandsForWhatWasSentOutsideOfCallbacks) {
  const System twin = build_twin(loop_of({0, 10 * kMs, 20 * kMs, 30 * kMs, 40 * kMs}, 50 * kMs).recording, {});
  ASSERT_EQ(twin.callbacks.size(), 1u);
  EXPECT_TRUE(twin.callbacks[0].replaces_loop);
  EXPECT_EQ(twin.callbacks[0].period_ns, 10 * kMs);
  EXPECT_EQ(twin.publishers[0].qos.depth, 3u);
  EXPECT_NE(twin.missing.front().find("a timer of 10 ms stands for that"), std::string::npos) << twin.missing.front();
}

// Four messages in 20 us are no timer of 6.67 us.
TEST(BuildTwin, NoTimerStandsForABurst) {
  const System twin = build_twin(loop_of({0, 5'000, 12'000, 20'000}, 1'000 * kMs).recording, {});
  EXPECT_TRUE(twin.callbacks.empty());
  EXPECT_NE(twin.missing.front().find("sent 4 messages on /a outside of its callbacks; the twin does not"),
            std::string::npos)
      << twin.missing.front();
}

// It has two callbacks in the trace. The publisher uses communication within the process, too.
TEST(BuildTwin, ASubscriptionWithIntraProcessCommunicationIsOne) {
  testing::HandRecording hand;
  hand.add_process();
  hand.add_process();
  const timeline::Index here = hand.add_node("/here", 0);
  const timeline::Index talker = hand.add_node("/talker", 0);
  const timeline::Index there = hand.add_node("/there", 1);
  const timeline::Index within = hand.add_subscription(here, "/a");
  hand.recording.timeline.callbacks.push_back(hand.recording.timeline.callbacks[within]);
  const timeline::Index beyond = within + 1;
  const timeline::Index thread = hand.add_thread(1);
  hand.recording.timeline.publishers = {{talker, 0}, {there, 0}};
  hand.recording.publishers = {{10, true, false}, {10, true, false}};
  for (std::int64_t time = 0; time < 100'000; time += 1'000) {
    hand.send(time + 10, hand.run(within, thread, time + 15, time + 16), 0);
    hand.recording.timeline.instances.back().intra_process = true;
    hand.send(time + 500, hand.run(beyond, thread, time + 580, time + 581), 1);
  }
  join_callbacks_of_subscriptions(hand.recording.timeline);
  const System twin = build_twin(hand.recording, {.cpus = 2});
  const auto subscriptions = std::count_if(twin.callbacks.begin(), twin.callbacks.end(), [](const Callback& callback) {
    return callback.kind == Callback::Kind::kSubscription;
  });
  ASSERT_EQ(subscriptions, 1);
  EXPECT_EQ(twin.callbacks[0].runs, 200u);
  EXPECT_EQ(twin.callbacks[0].near_delays.quantile(0.5), 5);
  EXPECT_EQ(twin.callbacks[0].delays.quantile(0.5), 80);
  EXPECT_TRUE(twin.nodes[0].intra_process);
  EXPECT_TRUE(twin.nodes[1].intra_process);
  EXPECT_FALSE(twin.nodes[2].intra_process);
  const Figures figures = figures_of(hand.recording, twin);
  EXPECT_EQ(figures.at({FigureKind::kHop, "/talker to /here, subscription /a"}).size(),
            99u);  // without the one before the first run
  EXPECT_EQ(figures.at({FigureKind::kHop, "/there to /here, subscription /a"}).size(), 100u);
}

// Two timers; the second one begins later.
testing::HandRecording late_by(std::int64_t late_ns) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index first = hand.add_timer(node);
  const timeline::Index second = hand.add_timer(node);
  for (std::int64_t time = 1'000; time < 5'000; time += 100) {
    hand.run(first, thread, time, time + 10);
    if (time >= 1'000 + late_ns) {
      hand.run(second, thread, time + 20, time + 30);
    }
  }
  return hand;
}

TEST(BeginOfFigures, IsWhenEachCallbackHasRunOnce) {
  const testing::HandRecording hand = late_by(800);
  EXPECT_EQ(begin_of_figures(hand.recording.timeline), 1'820);
  const System twin = build_twin(hand.recording, {});
  EXPECT_EQ(twin.up_ns, 820);
  EXPECT_EQ(figures_of(hand.recording, twin).begin()->second.size(), 31u);
}

TEST(BeginOfFigures, IsTheFirstRunIfOneBeginsInTheSecondHalfOrLeavesTooFewOfAnother) {
  EXPECT_EQ(begin_of_figures(late_by(2'500).recording.timeline), 1'000);
  testing::HandRecording few = late_by(800);
  const timeline::Index third = few.add_timer(0);
  for (std::int64_t time = 1'040; time < 2'040; time += 100) {
    few.run(third, 0, time, time + 10);
  }
  EXPECT_EQ(begin_of_figures(few.recording.timeline), 1'000);
}

TEST(BuildTwin, ASubscriptionKeepsItsQualityOfService) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  hand.run(subscription, hand.add_thread(1), 10, 20);
  const System twin = build_twin(hand.recording, {.bytes = 100, .sizes = {{"/a", 5000}}});
  ASSERT_EQ(twin.callbacks.size(), 1u);
  EXPECT_EQ(twin.callbacks[0].qos.depth, 5u);
  EXPECT_FALSE(twin.callbacks[0].qos.reliable);
  EXPECT_EQ(twin.topics[0].bytes, 5000u);
}

}  // namespace
}  // namespace tracing::twin
