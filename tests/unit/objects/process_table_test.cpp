// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/process_table.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

const Recording kMonday{.host = "robot", .machine = "boot-1", .session = "drive monday", .of_kernel = false};
const Recording kTuesday{.host = "robot", .machine = "boot-1", .session = "drive tuesday", .of_kernel = false};
const Recording kOtherHost{.host = "arm", .machine = "boot-2", .session = "drive monday", .of_kernel = false};
const Recording kKernel{.host = "robot", .machine = "boot-1", .session = "", .of_kernel = true};

EventClass class_of(std::size_t id, const Recording& recording) {
  return {.name = "ros2:rcl_take", .id = id, .trace = id, .fields = {}, .recording = &recording};
}

const EventClass kOfMonday = class_of(0, kMonday);
const EventClass kOfMondayToo = class_of(1, kMonday);
const EventClass kOfTuesday = class_of(2, kTuesday);
const EventClass kOfOtherHost = class_of(3, kOtherHost);
const EventClass kOfKernel = class_of(4, kKernel);

Event event_of(const EventClass& event_class, std::int64_t vpid, std::string_view procname = "node") {
  Event event;
  event.event_class = &event_class;
  event.vpid = vpid;
  event.vtid = vpid;
  event.procname = procname;
  return event;
}

TEST(ProcessTable, KeepsEqualIdsOfMachinesAndSessionsApart) {
  ProcessTable table;
  const ProcessId monday = table.of(event_of(kOfMonday, 71, "ping"));
  const ProcessId tuesday = table.of(event_of(kOfTuesday, 71, "pong"));
  const ProcessId other_host = table.of(event_of(kOfOtherHost, 71, "gripper"));
  EXPECT_EQ(table.of(event_of(kOfMonday, 71)), monday);
  EXPECT_EQ(table.of(event_of(kOfMondayToo, 71)), monday);
  ASSERT_EQ(table.processes().size(), 3u);
  EXPECT_EQ(table.processes()[monday].name, "ping");
  EXPECT_EQ(table.processes()[tuesday].name, "pong");
  EXPECT_EQ(table.processes()[other_host].name, "gripper");
  EXPECT_EQ(table.processes()[other_host].host, "arm");
}

TEST(ProcessTable, GivesEventsOfTheKernelToTheProcessThatIsTraced) {
  ProcessTable table;
  const ProcessId traced = table.of(event_of(kOfMonday, 71));
  EXPECT_EQ(table.of(event_of(kOfKernel, 71)), traced);
  const ProcessId seen_first = table.of(event_of(kOfKernel, 72));
  EXPECT_EQ(table.of(event_of(kOfMonday, 72)), seen_first);
  EXPECT_NE(table.of(event_of(kOfTuesday, 72)), seen_first);
  EXPECT_EQ(table.of(event_of(kOfKernel, 72)), seen_first);
}

TEST(ProcessTable, NamesAProcessAfterItsProgramAndNotAfterItsParent) {
  ProcessTable table;
  const ProcessId node = table.of(event_of(kOfKernel, 71, "launch"));
  table.of(event_of(kOfKernel, 71, "talker"));
  EXPECT_EQ(table.processes()[node].name, "talker") << "it has executed its program";
  table.of(event_of(kOfMonday, 71, "talker_node"));
  table.of(event_of(kOfKernel, 71, "renamed"));
  EXPECT_EQ(table.processes()[node].name, "talker_node");
}

TEST(ProcessTable, FindsAProcessOfTheSameSession) {
  ProcessTable table;
  const ProcessId launcher = table.of(event_of(kOfMonday, 70));
  const ProcessId started = table.of(event_of(kOfMondayToo, 71));
  table.of(event_of(kOfTuesday, 72));
  EXPECT_EQ(table.beside(launcher, 71), started);
  EXPECT_EQ(table.beside(launcher, 72), std::nullopt);
}

TEST(ProcessTable, TellsMachinesOfOneNameApartByTheirBoots) {
  const Recording namesake{.host = "robot", .machine = "0123456789ab", .session = "drive monday"};
  const EventClass of_namesake = class_of(5, namesake);
  ProcessTable table;
  const ProcessId monday = table.of(event_of(kOfMonday, 71));
  EXPECT_EQ(table.host_of(monday), "robot");
  const ProcessId other = table.of(event_of(of_namesake, 71));
  EXPECT_NE(other, monday);
  EXPECT_EQ(table.host_of(other), "robot (boot 01234567)");
  EXPECT_EQ(table.host_of(monday), "robot (boot boot-1)");
}

TEST(Recording, IsTheSameForTheHalvesOfADualSession) {
  const RecordingFacts snapshot{.hostname = "robot",
                                .domain = "ust",
                                .trace_name = "drive-snapshot",
                                .trace_creation_datetime = "20260101T000000+0000",
                                .clock_uuid = "boot-1",
                                .trace_uuid = "1"};
  RecordingFacts runtime = snapshot;
  runtime.trace_name = "drive-runtime";
  runtime.trace_creation_datetime = "20260101T010000+0000";
  runtime.trace_uuid = "2";
  EXPECT_EQ(recording_of(snapshot), recording_of(runtime));
}

TEST(Recording, DiffersForTwoSessionsOfOneName) {
  const RecordingFacts first{.hostname = "robot",
                             .domain = "ust",
                             .trace_name = "drive",
                             .trace_creation_datetime = "20260101T000000+0000",
                             .clock_uuid = "boot-1",
                             .trace_uuid = "1"};
  RecordingFacts second = first;
  second.trace_creation_datetime = "20260101T010000+0000";
  RecordingFacts kernel = first;
  kernel.domain = "kernel";
  EXPECT_FALSE(recording_of(first) == recording_of(second));
  EXPECT_EQ(recording_of(first).session, recording_of(kernel).session);
  EXPECT_TRUE(recording_of(kernel).of_kernel);
}

TEST(Recording, IsTheTraceWhenItHasNoSession) {
  EXPECT_EQ(recording_of({.trace_uuid = "1"}).session, "1");
}

}  // namespace
}  // namespace tracing
