// SPDX-License-Identifier: Apache-2.0
// Attributes lost events to processes, by the events that were fired and the events in the trace.

#include <gmock/gmock.h>

#include "tracing/record/account/counters/event_counters.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_attribution.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/losses_by_process.hpp"
#include "tracing/record/account/recorded_events.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

using testing::ElementsAre;
using tracing::EventCounts;
using tracing::LossAccount;
using tracing::LossAttribution;
using tracing::RecordedEvents;
using tracing::RecordedProcesses;

constexpr std::uint64_t kSecond = 1'000'000'000;

std::vector<EventCounts> talker_and_listener() {
  return {{.pid = 12,
           .process = "talker",
           .begin = kSecond,
           .end = 3 * kSecond,
           .cpu = kSecond / 2,
           .events = {{"ros2:rcl_publish", 1000}, {"ros2:callback_end", 500}, {"ros2_ext:rcl_node_fini", 3}}},
          {.pid = 13, .process = "listener", .begin = 2 * kSecond, .events = {{"ros2:rmw_take", 800}}}};
}

const RecordedEvents kRosEvents = {{{.channel = "ros2", .pattern = "ros2:*"}}};

LossAccount account(std::uint64_t discarded) {
  LossAccount losses;
  losses.channels = {{.domain = "ust", .channel = "ros2", .discarded_events = discarded}};
  losses.processes = tracing::account_processes(talker_and_listener(), kRosEvents, 5 * kSecond);
  return losses;
}

RecordedProcesses recorded() {
  return {{12, {.nodes = {"/talker"}, .events = {{"ros2:rcl_publish", 900}, {"ros2:callback_end", 500}}}},
          {13, {.nodes = {"/a/ear", "/a/other"}, .events = {{"ros2:rmw_take", 650}}}},
          {99, {.nodes = {}, .events = {{"launch:exec", 1}}}}};
}

TEST(ProcessAccount, SaysWhatProcessesFiredForHowLong) {
  const std::vector<tracing::ProcessAccount> processes =
      tracing::account_processes(talker_and_listener(), kRosEvents, 5 * kSecond);
  ASSERT_EQ(processes.size(), 2u);
  EXPECT_EQ(processes[0].name, "talker");
  EXPECT_EQ(processes[0].events, 1500u) << "another session records the event of ros2_ext";
  EXPECT_EQ(processes[0].callbacks, 500u);
  EXPECT_DOUBLE_EQ(processes[0].seconds, 2);
  EXPECT_DOUBLE_EQ(processes[0].cpu_seconds, 0.5);
  EXPECT_DOUBLE_EQ(processes[1].seconds, 3) << "it has not told its end";
}

TEST(ProcessAccount, AnEventCountsOnceForEachChannelOfTheSessionThatRecordsIt) {
  const RecordedEvents events = {
      {{.channel = "ros2", .pattern = "ros2:*", .exclusions = {"rmw_*"}},
       {.channel = "ros2", .pattern = "ros2:rcl_publish"},
       {.channel = "again", .pattern = "ros2:rcl_publish"},
       {.channel = "again", .pattern = "ros2:callback_end", .exclusions = {"ros2:callback_*"}}}};
  EXPECT_EQ(events.times("ros2:rcl_publish"), 2u);
  EXPECT_EQ(events.times("ros2:callback_end"), 1u);
  EXPECT_EQ(events.times("ros2:rmw_take"), 0u);
  const auto processes = tracing::account_processes(talker_and_listener(), events, 5 * kSecond);
  EXPECT_EQ(processes[0].events, 2500u);
  EXPECT_EQ(processes[1].events, 0u);
}

TEST(ProcessAccount, WhatWasFiredAndIsNotInTheTraceIsLost) {
  LossAccount losses = account(250);
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, recorded(), {});
  EXPECT_EQ(losses.processes[0].lost, 100u);
  EXPECT_EQ(losses.processes[1].lost, 150u);
  EXPECT_THAT(losses.processes[1].nodes, ElementsAre("/a/ear", "/a/other"));
  EXPECT_EQ(losses.attribution, LossAttribution::kExact);
  EXPECT_EQ(losses.unattributed, 0u);
  EXPECT_EQ(tracing::describe_losses(losses),
            "250 events lost in ust channel ros2\n"
            "lost by process: listener [13] 150 of 800 (nodes /a/ear, /a/other), talker [12] 100 of 1500 (node "
            "/talker)");
}

TEST(ProcessAccount, WhatProgramsLoseThatDoNotCountIsLeftOver) {
  LossAccount losses = account(257);
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, recorded(), {});
  EXPECT_EQ(losses.attribution, LossAttribution::kEstimate);
  EXPECT_EQ(losses.unattributed, 7u);
  EXPECT_THAT(tracing::describe_losses(losses), testing::EndsWith("; 7 by programs that do not count"));
}

TEST(ProcessAccount, IsAnEstimateWhenTheChannelsLostLess) {
  LossAccount losses = account(200);
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, recorded(), {});
  EXPECT_EQ(losses.attribution, LossAttribution::kEstimate);
  EXPECT_THAT(tracing::describe_losses(losses), testing::HasSubstr("\nlost by process, estimated: listener [13]"));
}

TEST(ProcessAccount, IsAnEstimateWherePacketsAreMissing) {
  LossAccount losses = account(250);
  losses.channels[0].lost_packets = 1;
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, recorded(), {});
  EXPECT_EQ(losses.attribution, LossAttribution::kEstimate);
}

TEST(ProcessAccount, IsAnEstimateWhereDataCouldNotBeWritten) {
  LossAccount losses = account(250);
  losses.damage = "the file system is full";
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, recorded(), {});
  EXPECT_EQ(losses.attribution, LossAttribution::kEstimate);
}

TEST(ProcessAccount, ALossIsZeroOnlyWhereItIsKnown) {
  tracing::TraceConfig config;
  config.session_name = "session_that_nobody_made";
  const auto look = [&config](const LossAccount& found) {
    LossAccount losses;
    tracing::LossesByProcess by_process(config, losses);
    losses = found;
    by_process.look_into("/nonexistent", {});
    return losses;
  };
  LossAccount losses = account(0);
  EXPECT_EQ(losses.processes[0].lost, std::nullopt) << "nobody has looked";
  EXPECT_EQ(look(losses).processes[0].lost, 0u);
  EXPECT_EQ(look(losses).attribution, LossAttribution::kExact);
  losses.damage = "the file system is full";
  EXPECT_EQ(look(losses).processes[0].lost, std::nullopt);
  EXPECT_EQ(look(losses).attribution, LossAttribution::kUnknown);
  losses.damage = "";
  losses.cut_short = true;
  EXPECT_EQ(look(losses).processes[0].lost, std::nullopt);
  EXPECT_EQ(look(losses).attribution, LossAttribution::kUnknown);
}

TEST(ProcessAccount, CountsWhatFilesOfALimitedSizeHaveOverwritten) {
  LossAccount losses = account(30);
  losses.channels[0].before_first = {.why = tracing::BeforeFirstPacket::kOverwrittenInFiles, .packets = 4};
  RecordedProcesses all = recorded();
  tracing::count_overwritten(losses, talker_and_listener(), kRosEvents, all);
  EXPECT_EQ(losses.channels[0].before_first.events, 220u);
  EXPECT_EQ(tracing::describe_losses(losses),
            "30 events lost in ust channel ros2\n"
            "at least 220 events overwritten in ust channel ros2, as asked: 4 packets in its oldest files");
  all.erase(99);
  tracing::count_overwritten(losses, talker_and_listener(), kRosEvents, all);
  EXPECT_FALSE(losses.channels[0].before_first.at_least) << "every process of the trace counts its events";
  EXPECT_FALSE(losses.complete());
  losses.channels[0].discarded_events = 0;
  EXPECT_FALSE(losses.complete());
  EXPECT_FALSE(losses.has_losses()) << "overwritten as asked";
}

TEST(ProcessAccount, NothingIsKnownOfEventsWithAConditionAndOfThoseThatWereNotAskedFor) {
  LossAccount losses = account(250);
  const RecordedEvents events = {{{.channel = "ros2", .pattern = "ros2:rcl_publish"},
                                  {.channel = "ros2", .pattern = "ros2:rmw_take"},
                                  {.channel = "ros2", .pattern = "ros2:rmw_*", .conditional = true}}};
  tracing::attribute_losses(losses, talker_and_listener(), events, recorded(), {});
  EXPECT_EQ(losses.processes[0].lost, 100u);
  EXPECT_EQ(losses.processes[1].lost, std::nullopt);
}

TEST(ProcessAccount, BuffersOfAProcessTellByThemselves) {
  LossAccount losses = account(40);
  const std::vector<tracing::Stream> streams = {
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 12, .packets = {{.discarded_events = 30}}},
      {.domain = "ust", .channel = "ros2", .cpu = "1", .pid = 12, .packets = {{.discarded_events = 5}}},
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 77, .packets = {{.discarded_events = 5}}}};
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, {}, streams);
  ASSERT_EQ(losses.processes.size(), 3u);
  EXPECT_EQ(losses.processes[0].lost, 35u);
  EXPECT_EQ(losses.processes[2].pid, 77);
  EXPECT_EQ(losses.processes[2].lost, 5u);
  EXPECT_EQ(losses.attribution, LossAttribution::kExact);
}

TEST(ProcessAccount, NothingIsKnownOfTheEventsOfLostPackets) {
  LossAccount losses = account(0);
  losses.channels[0].lost_packets = 3;
  const std::vector<tracing::Stream> streams = {
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 12, .packets = {{.sequence_number = 3}}},
      {.domain = "ust", .channel = "ros2", .cpu = "0", .pid = 13, .packets = {{.sequence_number = 0}}}};
  tracing::attribute_losses(losses, talker_and_listener(), kRosEvents, {}, streams);
  EXPECT_EQ(losses.processes[0].lost, std::nullopt);
  EXPECT_EQ(losses.processes[1].lost, 0u);
  EXPECT_EQ(losses.attribution, LossAttribution::kEstimate);
}

TEST(ProcessAccount, CostIsWhatTheEventsTake) {
  LossAccount losses = account(0);
  losses.cost = {.ns_per_event = 100, .cpu = "some processor", .lttng = "2.13.5", .context_fields = {}, .measured = ""};
  EXPECT_EQ(
      tracing::describe_cost(losses),
      "estimated cost of tracing: 0.000 s of processor time, 0.01 % of a processor; most in talker [12], 0.0 % of "
      "its own processor time, 0.3 µs for each callback (100 ns for each event)");
  EXPECT_DOUBLE_EQ(losses.processes[0].own_share(100), 1500 * 100e-9 / 0.5);
  EXPECT_EQ(losses.processes[1].own_share(100), 0);
}

TEST(ProcessAccount, AProcessOfAMillisecondCostsLittle) {
  LossAccount losses = account(0);
  losses.cost = {.ns_per_event = 100, .cpu = "some processor", .lttng = "2.13.5", .context_fields = {}, .measured = ""};
  losses.seconds = 4;
  losses.processes.push_back({.name = "true", .pid = 15, .seconds = 0.001, .events = 700, .counts = false});
  EXPECT_DOUBLE_EQ(losses.processes[2].processor_share(100), 0.07);
  const std::string text = tracing::describe_cost(losses);
  // 3000 events of 100 ns in 4 s.
  EXPECT_EQ(text.substr(0, text.find(',', text.find("most"))),
            "estimated cost of tracing: 0.000 s of processor time, 0.01 % of a processor; most in talker [12]");
}

TEST(ProcessAccount, WhatWasDroppedIsNotLost) {
  LossAccount losses;
  EXPECT_EQ(tracing::describe_completeness(losses), "complete");
  losses.cuts = {{.event_class = "executor"}, {.event_class = "layers"}};
  EXPECT_EQ(tracing::describe_completeness(losses), "complete but for what was asked to be dropped");
  EXPECT_EQ(tracing::describe_losses(losses), "dropped to keep to max-overhead: executor, layers");
  losses.cut_short = true;
  EXPECT_EQ(tracing::describe_completeness(losses), "incomplete");
}

TEST(ProcessAccount, EventsThatNobodyCountsCostAsWell) {
  LossAccount losses = account(0);
  RecordedProcesses with_malloc = recorded();
  with_malloc.at(12).events["lttng_ust_libc:malloc"] = 57'801;
  with_malloc[14] = {.events = {{"lttng_ust_libc:malloc", 3}, {"ros2:rcl_init", 1}}, .name = "sh", .seconds = 2.5};
  tracing::add_uncounted_events(losses.processes, with_malloc);
  ASSERT_EQ(losses.processes.size(), 3u) << "the launcher is none";
  EXPECT_EQ(losses.processes[0].events, 1500u + 57'801u);
  EXPECT_EQ(losses.processes[1].events, 800u);
  EXPECT_EQ(losses.processes[2].name, "sh");
  EXPECT_EQ(losses.processes[2].pid, 14);
  EXPECT_EQ(losses.processes[2].events, 4u) << "it counts nothing";
  EXPECT_DOUBLE_EQ(losses.processes[2].seconds, 2.5);
}

TEST(ProcessAccount, IsReadFromWhatLaunchReportPrints) {
  const RecordedProcesses parsed = tracing::parse_recorded_processes(
      R"json({"processes":[{"vpid":12,"nodes":["/talker"],"events":{"ros2:rcl_publish":900}}]})json");
  EXPECT_EQ(parsed.at(12).events.at("ros2:rcl_publish"), 900u);
  EXPECT_THROW(tracing::parse_recorded_processes("{}"), tracing::TraceError);
}

}  // namespace
