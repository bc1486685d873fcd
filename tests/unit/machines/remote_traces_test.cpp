// SPDX-License-Identifier: Apache-2.0
// Recordings on their way home, also those that a hostile machine sends.
#include "launcher/machines/remote_traces.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "launcher/machines/fetched_files.hpp"
#include "launcher/process/fake/fake_event_loop.hpp"
#include "launcher/traced/machine_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch;
using testing::ElementsAre;

class RemoteTracesTest : public testing::Test {
 protected:
  void say(FromAgent kind, const WireWriter& content) {
    WireReader reader(content.bytes());
    traces.receive(kind, reader);
    loop.run_until_idle();
  }
  MachineRecorder::Done into(std::vector<MachineRecorder::Outcome>& outcomes) {
    return [&outcomes](const MachineRecorder::Outcome& outcome) { outcomes.push_back(outcome); };
  }
  void fetch() { recorder->fetch(directory(), into(fetched)); }
  std::string directory() const { return sandbox.directory() / "arm"; }
  bool nothing_is_left() const {
    return !std::filesystem::exists(directory()) && !std::filesystem::exists(directory() + "~");
  }
  void say_file(const std::string& path, const std::string& bytes) {
    say(FromAgent::kTraceFile, WireWriter().u32(1).text(path).u64(bytes.size()));
    if (!bytes.empty()) {
      say(FromAgent::kTraceBytes, WireWriter().u32(1).rest(bytes));
    }
    say(FromAgent::kTraceSum, WireWriter().u32(1).u64(sum_of(bytes)));
  }
  std::string content(const std::string& path) const {
    std::ifstream file(directory() + "/" + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  test_support::Sandbox sandbox;
  FakeEventLoop loop;
  std::vector<ToAgent> sent;
  ClockOffset clock;
  std::vector<std::string> contents;
  RemoteTraces traces{loop, "arm", clock, [this](ToAgent kind, const WireWriter& content) {
                        sent.push_back(kind);
                        contents.push_back(content.bytes());
                      }};
  std::unique_ptr<MachineRecorder> recorder = traces.recorder();
  std::vector<MachineRecorder::Outcome> fetched;
};

TEST_F(RemoteTracesTest, BeginsAndEnds) {
  std::vector<MachineRecorder::Outcome> begun;
  std::vector<MachineRecorder::Outcome> ended;
  std::vector<std::string> warnings;
  recorder->begin(
      "what", [&](const std::string& text) { warnings.push_back(text); }, [](const MachineRecorder::Reason&) {},
      into(begun));
  say(FromAgent::kTraceTold, WireWriter().u32(1).text("the disk\x1b[31m is full"));
  say(FromAgent::kTraceBegun, WireWriter().u32(1).flag(true).text("").text("").text("/there/t-arm"));
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_TRUE(begun[0].well);
  EXPECT_EQ(begun[0].directory, "/there/t-arm");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].find('\x1b'), std::string::npos);
  recorder->end(false, into(ended));
  say(FromAgent::kTraceEnded, WireWriter().u32(1).flag(false).text("no daemon").text("start it").text(""));
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_FALSE(ended[0].well);
  EXPECT_EQ(ended[0].error, "no daemon");
  EXPECT_EQ(ended[0].help, "start it");
  EXPECT_THAT(sent, ElementsAre(ToAgent::kTraceBegin, ToAgent::kTraceEnd));
}

TEST_F(RemoteTracesTest, TakesSnapshotsThatAreFetchedAsTraces) {
  std::vector<MachineRecorder::Reason> reasons;
  recorder->begin(
      "what", [](const std::string&) {}, [&](const MachineRecorder::Reason& reason) { reasons.push_back(reason); },
      [](const MachineRecorder::Outcome&) {});
  say(FromAgent::kTraceBegun, WireWriter().u32(1).flag(true).text("").text("").text("/there/t-arm"));
  say(FromAgent::kTraceWish, WireWriter().u32(1).flag(false).text("event\nx").i32(0));
  say(FromAgent::kTraceWish, WireWriter().u32(1).flag(true).text("talker-1").i32(-11));
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_EQ(reasons[0].kind, MachineRecorder::Reason::Kind::kEvent);
  EXPECT_EQ(reasons[0].text.find('\n'), std::string::npos);
  EXPECT_EQ(reasons[1].kind, MachineRecorder::Reason::Kind::kEndOfProcess);
  EXPECT_EQ(reasons[1].text, "talker-1");
  EXPECT_EQ(reasons[1].code, -11);

  clock.add(1000, {.epoch_ns = 1'000'000, .monotonic_ns = 500'000}, {.epoch_ns = 1'000'000, .monotonic_ns = 700'000});
  EXPECT_EQ(recorder->clock_ahead(), 0);  // only the monotonic clocks differ
  std::vector<MachineRecorder::Outcome> taken;
  auto snapshot = recorder->take_snapshot({.reasons = {"event"}, .moment = 400'000}, into(taken));
  ASSERT_EQ(sent.back(), ToAgent::kTraceSnapshot);
  WireReader order(contents.back());
  EXPECT_EQ(order.u32(), 1U);
  EXPECT_EQ(order.u32(), 2U);
  const tracing::SnapshotOrder ordered = parse_snapshot_order(order.rest());
  EXPECT_THAT(ordered.reasons, ElementsAre("event"));
  EXPECT_NEAR(static_cast<double>(ordered.moment), 600'000, 1000);  // by the clock there
  say(FromAgent::kTraceEnded, WireWriter().u32(2).flag(true).text("").text("").text("/there/t-arm/snapshot-1"));
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].directory, "/there/t-arm/snapshot-1");
  snapshot->fetch(directory(), into(fetched));
  say(FromAgent::kTraceAll, WireWriter().u32(2).u32(0).u64(0));
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_TRUE(fetched[0].well);
  EXPECT_TRUE(std::filesystem::exists(directory() + "/clock.json"));
  snapshot->leave(true);
  snapshot.reset();
  say(FromAgent::kTraceFailed, WireWriter().u32(2).text("late"));  // passed over

  auto lost = recorder->take_snapshot({.reasons = {"event"}}, into(taken));
  traces.lose("it is silent");
  loop.run_until_idle();
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_TRUE(taken[1].lost);
  EXPECT_EQ(reasons.back().kind, MachineRecorder::Reason::Kind::kLost);
}

TEST_F(RemoteTracesTest, ATraceThatHasNotBegunWantsNothing) {
  const WireWriter message = WireWriter().u32(1).flag(false).text("event").i32(0);
  WireReader reader(message.bytes());
  EXPECT_THROW(traces.receive(FromAgent::kTraceWish, reader), WireError);
}

TEST_F(RemoteTracesTest, FilesComeHome) {
  fetch();
  const std::string large(kTraceWindow / 2, 'x');
  say_file("ust/uid/0/64-bit/ros2_0", large);
  say_file("empty", "");
  say_file("verdict.json", "{}");
  EXPECT_TRUE(fetched.empty());
  // Whatever ends the launch now, nobody takes this for the recording.
  EXPECT_FALSE(std::filesystem::exists(directory()));
  say(FromAgent::kTraceAll, WireWriter().u32(1).u32(3).u64(large.size() + 2));
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_TRUE(fetched[0].well) << fetched[0].error;
  EXPECT_EQ(content("ust/uid/0/64-bit/ros2_0"), large);
  EXPECT_EQ(content("verdict.json"), "{}");
  EXPECT_TRUE(std::filesystem::exists(directory() + "/empty"));
  EXPECT_FALSE(std::filesystem::exists(directory() + "~"));
  EXPECT_THAT(sent, ElementsAre(ToAgent::kTraceFetch, ToAgent::kTraceFetch));  // the second one is credit
}

TEST_F(RemoteTracesTest, NamesLeadNowhereElse) {
  for (const std::string path : {"", "/etc/passwd", "../up", "a/../../up", ".", "..", "a/./b", "a//b", "a/", "/",
                                 "clock.json", "ust/clock.json", "a\nb", "a\x7f", "\xff"}) {
    EXPECT_FALSE(is_path_of_fetched_file(path) && path != "\xff") << path;
    RemoteTraces others(loop, "arm", clock, [](ToAgent, const WireWriter&) {});
    const auto other = others.recorder();
    other->fetch(directory(), [](const MachineRecorder::Outcome&) {});
    const WireWriter message = WireWriter().u32(1).text(path).u64(1);
    WireReader reader(message.bytes());
    EXPECT_THROW(others.receive(FromAgent::kTraceFile, reader), WireError) << path;
    others.lose("it sends what it must not");
    EXPECT_TRUE(nothing_is_left()) << path;
  }
  EXPECT_FALSE(is_path_of_fetched_file("a/a/a/a/a/a/a/a/a/a/a/a/a/a"));
  EXPECT_FALSE(is_path_of_fetched_file(std::string(256, 'a')));
  EXPECT_TRUE(is_path_of_fetched_file("ust/uid/1000/64-bit/ros2_0"));
  EXPECT_TRUE(is_path_of_fetched_file("..a/.hidden"));
}

TEST_F(RemoteTracesTest, NoFileTwiceAndNoneThroughALink) {
  fetch();
  say_file("a", "1");
  say(FromAgent::kTraceFile, WireWriter().u32(1).text("a").u64(1));
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_FALSE(fetched[0].well);
  EXPECT_TRUE(nothing_is_left());
}

TEST_F(RemoteTracesTest, WhatIsNotTheSameIsRefused) {
  fetch();
  say(FromAgent::kTraceFile, WireWriter().u32(1).text("a").u64(3));
  EXPECT_THROW(say(FromAgent::kTraceBytes, WireWriter().u32(1).rest("four")), WireError);
  say(FromAgent::kTraceBytes, WireWriter().u32(1).rest("abc"));
  EXPECT_THROW(say(FromAgent::kTraceSum, WireWriter().u32(1).u64(sum_of("abd"))), WireError);
  EXPECT_THROW(say(FromAgent::kTraceAll, WireWriter().u32(1).u32(1).u64(3)), WireError);
  traces.lose("it sends what it must not");
  loop.run_until_idle();
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_TRUE(fetched[0].lost);
  EXPECT_TRUE(nothing_is_left());
}

TEST_F(RemoteTracesTest, MoreThanTheCreditIsRefused) {
  fetch();
  say(FromAgent::kTraceFile, WireWriter().u32(1).text("a").u64(std::uint64_t{4} << 20U));
  const std::string piece(kTraceWindow + 1, 'x');
  EXPECT_THROW(say(FromAgent::kTraceBytes, WireWriter().u32(1).rest(piece)), WireError);
}

TEST_F(RemoteTracesTest, AFileThatIsLargerThanTheDiskIsNotBegun) {
  fetch();
  say(FromAgent::kTraceFile, WireWriter().u32(1).text("a").u64(std::uint64_t{1} << 62U));
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_THAT(fetched[0].error, testing::HasSubstr("No space left on device"));
}

TEST_F(RemoteTracesTest, AConnectionThatIsCutMeanwhileLeavesNothing) {
  fetch();
  say_file("ust/uid/0/64-bit/ros2_0", "events");
  say_file("verdict.json", R"({"complete": true})");  // all is there, and nobody knows
  traces.lose("the connection to machine 'arm' is lost");
  loop.run_until_idle();
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_FALSE(fetched[0].well);
  EXPECT_TRUE(fetched[0].lost);
  EXPECT_EQ(fetched[0].error, "the connection to machine 'arm' is lost");
  EXPECT_TRUE(nothing_is_left());
}

TEST_F(RemoteTracesTest, WhatIsThereStays) {
  std::filesystem::create_directory(directory());
  fetch();
  loop.run_until_idle();
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_FALSE(fetched[0].well);
  EXPECT_EQ(fetched[0].error, "cannot write '" + directory() + "': File exists");
  EXPECT_TRUE(std::filesystem::exists(directory()));
}

TEST_F(RemoteTracesTest, HurryLeavesThemThere) {
  fetch();
  say_file("a", "1");
  recorder->hurry();
  loop.run_until_idle();
  ASSERT_EQ(fetched.size(), 1U);
  EXPECT_EQ(fetched[0].error, "the launch was to end at once");
  EXPECT_TRUE(nothing_is_left());
  say(FromAgent::kTraceFile, WireWriter().u32(1).text("b").u64(1));  // it was on its way
}

TEST_F(RemoteTracesTest, UnaskedMessagesAreRefused) {
  EXPECT_THROW(say(FromAgent::kTraceBegun, WireWriter().u32(1).flag(true).text("").text("").text("")), WireError);
  EXPECT_THROW(say(FromAgent::kTraceFile, WireWriter().u32(1).text("a").u64(1)), WireError);
  EXPECT_THROW(say(FromAgent::kTraceTold, WireWriter().u32(2).text("a")), WireError);
}

TEST(MachineTraceWire, IsReadAsItWasWritten) {
  MachineTrace trace;
  trace.config.session_name = "walk-arm";
  trace.config.events_ust = {"ros2:*", "mine:* except mine:b"};
  trace.config.context_fields_ust = {"vpid"};
  trace.config.ust.subbuffer_size = 4096;
  trace.config.ust.blocking_timeout = -1;
  trace.config.switch_timer_ust = 7;
  trace.config.overwrite_ust = true;
  trace.config.buffers_ust = tracing::BufferOwner::kProcess;
  trace.config.channels.push_back({.name = "more", .events_ust = {"a:b"}, .read_timer = 9});
  trace.config.max_overhead = 0.02;
  trace.config.drop_order = {"executor"};
  trace.choices.nodes = {"talker", "/li*"};
  trace.choices.tracetools = TracetoolsMode::kTheirs;
  trace.choices.python_nodes = true;
  trace.config.snapshot_mode = true;
  trace.config.snapshot_size = 1 << 22;
  trace.choices.snapshot_on_crash = true;
  trace.choices.snapshot_on_events = {"mine:late if by > 5"};
  trace.choices.callback_deadline = 2.5;
  trace.choices.message_deadline = 0.5;
  ProcessSpec spec;
  spec.name = "talker";
  spec.argv = {"/bin/talker", "-v"};
  spec.environment = Environment({{"PATH", "/bin"}, {"OTHER", "1"}});
  spec.traced = false;
  trace.processes.push_back(spec);
  const std::string bytes = to_wire(trace);
  const MachineTrace read = parse_machine_trace(bytes);
  EXPECT_EQ(to_wire(read), bytes);
  EXPECT_EQ(read.config.channels.at(0).read_timer, 9U);
  EXPECT_EQ(read.config.max_overhead, 0.02);
  EXPECT_TRUE(read.config.records_snapshots());
  EXPECT_EQ(read.config.snapshot_size, 1U << 22);
  EXPECT_EQ(read.choices.watched_events(), trace.choices.watched_events());
  EXPECT_EQ(read.choices.message_deadline, 0.5);
  EXPECT_EQ(read.choices.nodes, trace.choices.nodes);
  EXPECT_FALSE(read.processes.at(0).traced);
  EXPECT_EQ(read.processes.at(0).environment.size(), 1U);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(parse_machine_trace(bytes.substr(0, size)), WireError);
  }
}

TEST(MachineTraceWire, NamesThatLeadElsewhereAreRefused) {
  for (const char* const name : {"", "../up", "a/b", ".hidden"}) {
    MachineTrace trace;
    trace.config.session_name = name;
    EXPECT_THROW(parse_machine_trace(to_wire(trace)), WireError) << name;
  }
}

}  // namespace
