// SPDX-License-Identifier: Apache-2.0
// The verdict on a trace that lost events, from packets that the tests make up.
#include "tracing/record/account/verdict.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/account/unwritten_data.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace {

using tracing::ChannelLoss;
using tracing::LossAccount;

using tracing::Stream;

struct Verdict : testing::Test {
  Stream stream(const std::string& cpu, std::vector<tracing::Packet> packets) const {
    return {.domain = "ust", .channel = "ros2", .cpu = cpu, .packets = std::move(packets)};
  }

  LossAccount account(std::uint64_t discarded) const {
    LossAccount result;
    result.channels = {{.domain = "ust", .channel = "ros2", .discarded_events = discarded}};
    result.channels[0].subbuffer_size = 32768;
    result.channels[0].subbuffer_count = 2;
    return result;
  }

  test_support::Sandbox sandbox;
};

TEST_F(Verdict, NamesTheRunsOfLossesAndTheBuffersThatWouldHaveHeld) {
  LossAccount losses = account(1500);
  tracing::explain_losses(losses, {stream("0", {{1000, 2000, 32000, 0},
                                                {2100, 3000, 32000, 300},
                                                {3100, 4000, 32000, 1000},
                                                {4100, 5000, 100, 1000},
                                                {5100, 6000, 32000, 1500}}),
                                   stream("1", {{900, 5900, 500, 0}})});
  const ChannelLoss& channel = losses.channels.at(0);
  EXPECT_EQ(channel.bytes, 4 * 32000u + 100u + 500u);
  ASSERT_EQ(channel.ranges.size(), 2u);
  EXPECT_EQ(channel.ranges[0].cpu, "0");
  EXPECT_EQ(channel.ranges[0].begin_ns, 1100u);
  EXPECT_EQ(channel.ranges[0].end_ns, 3100u);
  EXPECT_EQ(channel.ranges[0].events, 1000u);
  EXPECT_EQ(channel.ranges[1].events, 500u);
  // 2 * (2 * 32 KiB + 1000 * 128 bytes) in 4 sub-buffers, rounded up.
  EXPECT_EQ(channel.advised_subbuffer_size, 131072u);
  EXPECT_EQ(tracing::describe_losses(losses),
            "1500 events lost in ust channel ros2 with 2 sub-buffers of 32768 bytes; 4 of 131072 would have held them");
}

TEST_F(Verdict, ARunOfLossesDoesNotBeginAnewWhereATotalGoesBack) {
  LossAccount losses = account(301);
  tracing::explain_losses(
      losses,
      {stream("0",
              {{1000, 2000, 32000, 0}, {2000, 3000, 32000, 300}, {3000, 4000, 32000, 0}, {4000, 5000, 32000, 301}})});
  const ChannelLoss& channel = losses.channels.at(0);
  ASSERT_EQ(channel.ranges.size(), 2u);
  EXPECT_EQ(channel.ranges[0].events, 300u);
  EXPECT_EQ(channel.ranges[1].events, 1u);
}

TEST_F(Verdict, AdvisesNothingWhereNoBufferHelps) {
  LossAccount losses = account(10'000'000);
  tracing::explain_losses(losses, {stream("0", {{1000, 2000, 32000, 10'000'000}})});
  EXPECT_EQ(losses.channels.at(0).advised_subbuffer_size, 0u);
}

TEST_F(Verdict, AdvisesNoSubbuffersThatAreLargerThanTheFilesOfTheChannel) {
  LossAccount losses = account(1000);
  losses.channels[0].tracefile_size = 70'000;
  tracing::explain_losses(losses, {stream("0", {{1000, 2000, 32000, 1000}})});
  // The same 2 * (2 * 32 KiB + 1000 * 128 bytes) as above.
  EXPECT_EQ(losses.channels[0].advised_subbuffer_size, 65536u);
  EXPECT_EQ(losses.channels[0].advised_subbuffer_count, 8u);
}

TEST_F(Verdict, SaysWhatIsMissingBeforeTheFirstPacket) {
  LossAccount losses = account(0);
  losses.channels[0].before_first = {
      .why = tracing::BeforeFirstPacket::kOverwrittenInFiles, .packets = 7, .discarded_events = 3};
  tracing::explain_losses(losses, {stream("0", {{1000, 2000, 32000, 3, 7}})});
  EXPECT_TRUE(losses.channels[0].ranges.empty()) << "nobody knows where";
  EXPECT_EQ(tracing::describe_losses(losses),
            "some events overwritten in ust channel ros2, as asked: 7 packets in its oldest files\n"
            "3 events lost in ust channel ros2 before the end of the first packet that is left");
  EXPECT_FALSE(losses.complete());
  EXPECT_NE(tracing::verdict_as_json(losses, "run").find("\"why\": \"overwritten, as asked\",\n"), std::string::npos);
  losses.channels[0].before_first = {.why = tracing::BeforeFirstPacket::kLost, .packets = 1};
  EXPECT_EQ(tracing::describe_losses(losses), "1 packet lost in ust channel ros2 before the first that was read");
  losses.channels[0].before_first.why = tracing::BeforeFirstPacket::kRemoved;
  EXPECT_EQ(tracing::describe_losses(losses), "1 packet of ust channel ros2 cleared or moved away");
}

TEST_F(Verdict, SaysThatTheDaemonHasCounted) {
  LossAccount losses = account(12);
  losses.channels[0].counted_by = tracing::LossSource::kDaemon;
  EXPECT_EQ(tracing::describe_losses(losses),
            "12 events lost in ust channel ros2 with 2 sub-buffers of 32768 bytes (as the session daemon counts)");
}

TEST_F(Verdict, IsCompleteWithoutLossesAndWrittenAsJson) {
  LossAccount losses = account(0);
  const std::filesystem::path directory = sandbox.directory() / "run";
  losses.attribution = tracing::LossAttribution::kExact;
  losses.processes = {{.name = "talker",
                       .pid = 12,
                       .seconds = 2,
                       .cpu_seconds = 0.5,
                       .events = 1000,
                       .callbacks = 50,
                       .reached_after = 0.125,
                       .lost = 0}};
  losses.cost = {.ns_per_event = 100,
                 .cpu = "some processor",
                 .lttng = "2.13.5",
                 .context_fields = {"vpid"},
                 .measured = "2026-11-21 20:15:00"};
  losses.cuts = {{.event_class = "executor",
                  .events = {"ros2:rclcpp_executor_execute"},
                  .time = 77,
                  .rate = 300'000,
                  .share = 0.03}};
  losses.tracetools = {
      {.process = "talker",
       .is_own = true,
       .theirs = "/opt/ros/lib/libtracetools.so",
       .version = "8.2.3",
       .reason = ""},
      {.process = "arm", .is_own = false, .theirs = "", .version = "", .reason = "it is linked statically"}};
  tracing::explain_losses(losses, {stream("0", {{1000, 2000, 32000, 0}})});
  std::filesystem::create_directories(directory);
  tracing::write_verdict(losses, "run", directory);
  EXPECT_EQ(test_support::read_file(directory / tracing::kVerdictFile), R"json({
  "session": "run",
  "complete": true,
  "cut_short": false,
  "damage": "",
  "absent": [],
  "discarded_events": 0,
  "lost_packets": 0,
  "channels": [
    {
      "domain": "ust",
      "channel": "ros2",
      "subbuffer_size": 32768,
      "subbuffer_count": 2,
      "bytes": 32000,
      "discarded_events": 0,
      "lost_packets": 0,
      "counted_by": "packets",
      "lost": []
    }
  ],
  "lost_by_process": {
    "method": "exact",
    "unattributed": 0
  },
  "event_cost": {
    "ns": 100.0,
    "measured": "2026-11-21 20:15:00",
    "cpu": "some processor",
    "lttng": "2.13.5",
    "context_fields": [
      "vpid"
    ]
  },
  "cuts": [
    {
      "class": "executor",
      "events": [
        "ros2:rclcpp_executor_execute"
      ],
      "time_ns": 77,
      "rate": 300000,
      "processor_share": 0.03
    }
  ],
  "tracetools": [
    {
      "process": "talker",
      "uses": "own",
      "theirs": "/opt/ros/lib/libtracetools.so",
      "version": "8.2.3"
    },
    {
      "process": "arm",
      "uses": "theirs",
      "reason": "it is linked statically"
    }
  ],
  "processes": [
    {
      "name": "talker",
      "pid": 12,
      "seconds": 2.0,
      "events": 1000,
      "callbacks": 50,
      "recorded_after_s": 0.125,
      "missed_events": 0,
      "lost": 0,
      "tracing": {
        "seconds": 0.0001,
        "processor_share": 5e-05,
        "own_share": 0.0002,
        "ns_per_callback": 2000.0
      }
    }
  ]
}
)json");
}

TEST_F(Verdict, OfTheFirstRecordingTellsOfThoseThatWereAppended) {
  const std::filesystem::path run = sandbox.directory() / "run";
  std::filesystem::create_directories(run / "appended-1");
  tracing::note_appended(run / "appended-1", true);
  EXPECT_FALSE(std::filesystem::exists(run / "verdict.json")) << "the first one has none";
  tracing::write_verdict(account(0), "run", run);
  const auto says = [&run](const std::string& text) {
    return test_support::read_file(run / "verdict.json").find(text) != std::string::npos;
  };
  tracing::note_appended(run / "appended-1", true);
  EXPECT_TRUE(says("\"complete\": true"));
  tracing::note_appended(run / "appended-2", false);
  EXPECT_TRUE(says("\"complete\": false"));
  EXPECT_TRUE(says("\"appended-1\": true"));
  EXPECT_TRUE(says("\"appended-2\": false"));
}

TEST_F(Verdict, ThatCannotBeWrittenIsAnError) {
  const std::string path = sandbox.directory() / "nowhere" / "verdict.json";
  try {
    tracing::write_verdict(account(0), "run", sandbox.directory() / "nowhere");
    FAIL();
  } catch (const tracing::TraceError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot write " + path + ": No such file or directory");
  }
}

TEST_F(Verdict, ReplacesAPlantedLinkAndLeavesItsTargetAsItWas) {
  test_support::write_file(sandbox.directory() / "target", "precious\n");
  for (const char* recording : {"run", "snapshot-1"}) {
    std::filesystem::create_directories(sandbox.directory() / recording);
    std::filesystem::create_symlink("../target", sandbox.directory() / recording / "verdict.json");
  }
  tracing::write_verdict(account(0), "run", sandbox.directory() / "run");
  tracing::write_snapshot_verdict(sandbox.directory() / "snapshot-1", "run", {}, {});
  for (const char* recording : {"run", "snapshot-1"}) {
    const std::filesystem::path verdict = sandbox.directory() / recording / "verdict.json";
    EXPECT_FALSE(std::filesystem::is_symlink(verdict));
    EXPECT_EQ(test_support::read_file(verdict).substr(0, 15), "{\n  \"session\": ");
  }
  EXPECT_EQ(test_support::read_file(sandbox.directory() / "target"), "precious\n");
}

TEST_F(Verdict, OfASnapshotSaysWhyItWasTakenAndWhatIsMissingInIt) {
  const std::filesystem::path snapshot = sandbox.directory() / "snapshot-1";
  tracing::testing::TraceWriter writer(snapshot / "ust/uid/0/64-bit");
  const tracing::testing::Thread thread{.vpid = 1, .vtid = 1, .procname = "a"};
  writer.write(0, 1000, thread, tracing::ros2::RclTake{1});
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.lose_packets(0, 3);
  writer.write(0, 2000, thread, tracing::ros2::RclTake{1});
  writer.write(1, 500, thread, tracing::ros2::RclTake{1});
  writer.finish();
  const std::vector<Stream> streams = tracing::read_streams(snapshot);
  tracing::write_snapshot_verdict(snapshot, "run",
                                  {.reasons = {"c-1 died of SIGSEGV", "SIGUSR1"},
                                   .absences = {{"b [2] had ended"}},
                                   .unwritten = tracing::unfinished_streams(streams, 1500),
                                   .damage = "unfinished"},
                                  streams);
  EXPECT_EQ(test_support::read_file(snapshot / "verdict.json"),
            "{\n"
            "  \"session\": \"run\",\n"
            "  \"reasons\": [\n"
            "    \"c-1 died of SIGSEGV\",\n"
            "    \"SIGUSR1\"\n"
            "  ],\n"
            "  \"complete\": false,\n"
            "  \"damage\": \"unfinished\",\n"
            "  \"absent\": [\n"
            "    \"b [2] had ended\"\n"
            "  ],\n"
            "  \"discarded_events\": 12,\n"
            "  \"lost_packets\": 3,\n"
            "  \"bytes\": {\n"
            "    \"ust\": 381\n"
            "  },\n"
            "  \"begin_ns\": 500,\n"
            "  \"end_ns\": 2000,\n"
            "  \"lost\": [\n"
            "    {\n"
            "      \"channel\": \"ros2\",\n"
            "      \"cpu\": \"0\",\n"
            "      \"begin_ns\": 500,\n"
            "      \"end_ns\": 1500,\n"
            "      \"events\": 12,\n"
            "      \"packets\": 3\n"
            "    }\n"
            "  ],\n"
            "  \"unwritten\": [\n"
            "    {\n"
            "      \"channel\": \"ros2\",\n"
            "      \"cpu\": \"1\",\n"
            "      \"begin_ns\": 0,\n"
            "      \"end_ns\": 1000\n"
            "    }\n"
            "  ]\n"
            "}\n");
  EXPECT_EQ(tracing::describe_snapshot_losses(streams), "12 events lost, processor 0 (channel ros2)");
}

}  // namespace
