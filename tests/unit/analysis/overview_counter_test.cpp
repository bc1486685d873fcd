// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/overview_counter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tracing {
namespace {

using ::testing::ElementsAre;

Event event_of(const EventClass& event_class, std::int64_t time_ns, std::int64_t vpid, std::int64_t vtid,
               std::string_view procname) {
  Event event;
  event.event_class = &event_class;
  event.timestamp_ns = time_ns;
  event.vpid = vpid;
  event.vtid = vtid;
  event.procname = procname;
  return event;
}

const EventClass kTake{"ros2:rcl_take", 0, 0, {"message"}};
const EventClass kStart{"ros2:callback_start", 1, 0, {"callback", "is_intra_process"}};
const EventClass kTakeInOtherTrace{"ros2:rcl_take", 2, 1, {"message"}};

TEST(OverviewCounter, CountsByNameAndProcess) {
  OverviewCounter counter;
  counter.on_event(event_of(kTake, 1000, 72, 72, "pong"));
  counter.on_event(event_of(kTake, 2000, 71, 71, "ping"));
  counter.on_event(event_of(kTakeInOtherTrace, 2500, 71, 71, "ping"));
  counter.on_event(event_of(kStart, 3000, 71, 71, "ping"));

  const TraceOverview overview = counter.overview();

  EXPECT_EQ(overview.events, 4u);
  EXPECT_EQ(overview.begin_ns, 1000);
  EXPECT_EQ(overview.end_ns, 3000);
  ASSERT_EQ(overview.processes.size(), 2u);
  EXPECT_EQ(overview.processes[0].vpid, 71);
  EXPECT_EQ(overview.processes[0].name, "ping");
  EXPECT_EQ(overview.processes[0].events, 3u);
  EXPECT_EQ(overview.processes[1].events, 1u);
  ASSERT_EQ(overview.event_counts.size(), 2u);
  EXPECT_EQ(overview.event_counts[0].name, "ros2:callback_start");
  EXPECT_THAT(overview.event_counts[0].by_process, ElementsAre(1, 0));
  EXPECT_EQ(overview.event_counts[1].name, "ros2:rcl_take");
  EXPECT_THAT(overview.event_counts[1].by_process, ElementsAre(2, 1));
  EXPECT_EQ(overview.event_counts[1].total, 3u);
}

TEST(OverviewCounter, CountsTheEventsOfTheLauncherWithoutAProcess) {
  const EventClass exec{"launch:exec", 0, 0, {"time"}};
  OverviewCounter counter;
  counter.on_event(event_of(exec, 500, 70, 70, "launch"));
  counter.on_event(event_of(kStart, 1000, 71, 71, "ping"));
  const TraceOverview overview = counter.overview();
  EXPECT_EQ(overview.events, 1u);
  EXPECT_EQ(overview.processes.size(), 1u);
  ASSERT_EQ(overview.event_counts.size(), 2u);
  EXPECT_EQ(overview.event_counts[0].name, "launch:exec");
  EXPECT_EQ(overview.event_counts[0].total, 1u);
  EXPECT_THAT(overview.event_counts[0].by_process, ElementsAre(0));
  EXPECT_EQ(overview.event_counts[1].name, "ros2:callback_start");
}

TEST(OverviewCounter, NamesAProcessAfterItsMainThread) {
  OverviewCounter counter;
  counter.on_event(event_of(kTake, 1, 71, 75, "dds.listener"));
  EXPECT_EQ(counter.overview().processes[0].name, "dds.listener");
  counter.on_event(event_of(kTake, 2, 71, 71, "ping"));
  counter.on_event(event_of(kTake, 3, 71, 75, "dds.listener"));
  EXPECT_EQ(counter.overview().processes[0].name, "ping");
}

TEST(OverviewCounter, PutsEventsWithoutVpidTogether) {
  OverviewCounter counter;
  Event event;
  event.event_class = &kTake;
  counter.on_event(event);
  counter.on_event(event);
  const TraceOverview overview = counter.overview();
  ASSERT_EQ(overview.processes.size(), 1u);
  EXPECT_EQ(overview.processes[0].vpid, std::nullopt);
  EXPECT_EQ(overview.processes[0].events, 2u);
}

// A machine has thousands of processes that only the kernel's events show.
TEST(OverviewCounter, FoldsWhatTheKernelAloneShowsBehindTheOthers) {
  const EventClass sched{"sched_switch", 3, 0, {"prev_tid", "next_tid"}};
  OverviewCounter counter;
  for (std::int64_t id = 1; id <= 1'000; ++id) {
    counter.on_event(event_of(sched, id, id, id, "kworker/" + std::to_string(id)));
    counter.on_event(event_of(sched, id, 2'000 + id, 2'000 + id, ""));
  }
  counter.on_event(event_of(sched, 2'000, 5'001, 5'001, "sshd"));
  counter.on_event(event_of(kTake, 3'000, 9'071, 9'071, "ping"));
  counter.on_event(event_of(sched, 3'000, 9'071, 9'071, "ping"));

  const TraceOverview overview = counter.overview();

  ASSERT_EQ(overview.processes.size(), 4u);
  EXPECT_EQ(overview.processes[0].name, "ping");
  EXPECT_EQ(overview.processes[0].vpid, 9'071);
  EXPECT_EQ(overview.processes[0].folded, 0u);
  EXPECT_EQ(overview.processes[0].events, 2u);
  EXPECT_EQ(overview.processes[1].name, "");
  EXPECT_EQ(overview.processes[1].folded, 1'000u);
  EXPECT_EQ(overview.processes[1].vpid, std::nullopt);
  EXPECT_EQ(overview.processes[2].name, "kworker");
  EXPECT_EQ(overview.processes[2].events, 1'000u);
  EXPECT_EQ(overview.processes[3].name, "sshd");
  EXPECT_EQ(overview.processes[3].vpid, 5'001) << "it is alone";
  EXPECT_EQ(overview.folded_processes(), 2'001u);
  EXPECT_THAT(overview.event_counts[1].by_process, ElementsAre(1, 1'000, 1'000, 1));
  EXPECT_EQ(counter.places().size(), 2'002u);
}

Loss loss_of(const Stream& stream, Loss::Kind kind, std::optional<std::uint64_t> count, std::int64_t begin,
             std::int64_t end) {
  return {kind, &stream, begin, end, count};
}

TEST(OverviewCounter, AddsUpTheLossesOfAStream) {
  const Stream stream{"ros2_0", 0, std::nullopt};
  OverviewCounter counter;
  counter.on_event(event_of(kTake, 1, 71, 71, "ping"));
  counter.on_event(event_of(kTake, 1, 72, 72, "pong"));
  counter.on_loss(loss_of(stream, Loss::Kind::kEvents, 30, 100, 200));
  counter.on_loss(loss_of(stream, Loss::Kind::kEvents, 7, 300, 400));
  counter.on_loss(loss_of(stream, Loss::Kind::kPackets, 2, 50, 60));

  const TraceOverview overview = counter.overview();

  ASSERT_EQ(overview.losses.size(), 1u);
  EXPECT_EQ(overview.losses[0].events, 37u);
  EXPECT_EQ(overview.losses[0].packets, 2u);
  EXPECT_FALSE(overview.losses[0].uncounted);
  EXPECT_EQ(overview.losses[0].begin_ns, 50);
  EXPECT_EQ(overview.losses[0].end_ns, 400);
  EXPECT_THAT(overview.losses[0].processes, ElementsAre(0, 1));
  EXPECT_TRUE(overview.processes[0].doubtful);
  EXPECT_EQ(overview.lost_events(), 37u);
  EXPECT_EQ(overview.lost_packets(), 2u);
}

TEST(OverviewCounter, DoubtsOnlyTheProcessesThatUsedTheBuffer) {
  const Stream shared{"other/ros2_0", 1, std::nullopt};
  const Stream own{"ust/pid/pong-72/ros2_0", 0, 72};
  OverviewCounter counter;
  counter.on_event(event_of(kTake, 1, 71, 71, "ping"));
  counter.on_event(event_of(kTake, 1, 72, 72, "pong"));
  counter.on_event(event_of(kTakeInOtherTrace, 1, 73, 73, "talker"));
  counter.on_loss(loss_of(shared, Loss::Kind::kEvents, std::nullopt, 1, 2));
  counter.on_loss(loss_of(own, Loss::Kind::kEvents, 1, 1, 2));

  const TraceOverview overview = counter.overview();

  EXPECT_FALSE(overview.processes[0].doubtful);
  EXPECT_TRUE(overview.processes[1].doubtful);
  EXPECT_TRUE(overview.processes[2].doubtful);
  EXPECT_THAT(overview.losses[0].processes, ElementsAre(2));
  EXPECT_TRUE(overview.losses[0].uncounted);
  EXPECT_THAT(overview.losses[1].processes, ElementsAre(1));
  EXPECT_TRUE(overview.lost_uncounted());
}

}  // namespace
}  // namespace tracing
