// SPDX-License-Identifier: Apache-2.0
// The times at which processes of the launcher had a node and were ready.
#include "tracing/model/analysis/start_tracker.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr std::int64_t kEpoch = 1'767'225'600'000'000'000;  // time of CLOCK_MONOTONIC's zero
constexpr Thread kLauncher{70, 70, "launch"};
constexpr Thread kTalker{71, 71, "talker"};

class Sink : public TraceSink {
 public:
  void on_event(const Event& event) override { tracker.on_event(event, processes.of(event)); }
  void on_loss(const Loss&) override {}
  ProcessTable processes;
  StartTracker tracker;
};

class StartOfProcesses : public ::testing::Test {
 protected:
  // liblaunch_trace records the event at time `recorded`; it happened at `time`.
  void exec(std::int64_t recorded, std::int64_t time, const std::string& process, std::int32_t pid) {
    if (!exec_) {
      exec_ = writer_.declare("launch:exec",
                              "\t\tinteger { size = 64; align = 8; signed = 1; } _time;\n\t\tstring _process;\n"
                              "\t\tinteger { size = 32; align = 8; signed = 1; } _pid;\n\t\tstring _file;\n"
                              "\t\tinteger { size = 32; align = 8; signed = 0; } _line;\n");
    }
    std::string payload;
    testing::detail::append(payload, time);
    payload.append(process).push_back('\0');
    testing::detail::append(payload, pid);
    payload.append("a.launch.xml").push_back('\0');
    testing::detail::append(payload, std::uint32_t{3});
    writer_.write_raw(0, kEpoch + recorded, kLauncher, *exec_, payload);
  }
  void signal(std::int64_t time, const std::string& process, std::int32_t number) {
    if (!signal_) {
      signal_ = writer_.declare("launch:signal",
                                "\t\tinteger { size = 64; align = 8; signed = 1; } _time;\n\t\tstring _process;\n"
                                "\t\tinteger { size = 32; align = 8; signed = 1; } _signal;\n\t\tstring _file;\n"
                                "\t\tinteger { size = 32; align = 8; signed = 0; } _line;\n");
    }
    std::string payload;
    testing::detail::append(payload, time);
    payload.append(process).push_back('\0');
    testing::detail::append(payload, number);
    payload.append("a.launch.xml").push_back('\0');
    testing::detail::append(payload, std::uint32_t{3});
    writer_.write_raw(0, kEpoch + time, kLauncher, *signal_, payload);
  }
  // An event with two texts: a condition or a priority.
  void change(const std::string& event, std::int64_t time, const std::string& subject_field, const std::string& subject,
              const std::string& change) {
    const std::uint16_t id = writer_.declare(
        "launch:" + event, "\t\tinteger { size = 64; align = 8; signed = 1; } _time;\n\t\tstring _" + subject_field +
                               ";\n\t\tstring _change;\n\t\tstring _file;\n"
                               "\t\tinteger { size = 32; align = 8; signed = 0; } _line;\n");
    std::string payload;
    testing::detail::append(payload, time);
    payload.append(subject).push_back('\0');
    payload.append(change).push_back('\0');
    payload.append("a.launch.xml").push_back('\0');
    testing::detail::append(payload, std::uint32_t{5});
    writer_.write_raw(0, kEpoch + time, kLauncher, id, payload);
  }
  template <class Struct>
  void write(std::int64_t time, const Thread& thread, const Struct& event) {
    writer_.write(0, kEpoch + time, thread, event);
  }
  std::vector<StartResult> results() { return all_results().starts; }
  TraceResults all_results() {
    writer_.finish();
    Sink sink;
    TraceReader(directory_.path()).read(sink);
    ends_ = sink.tracker.ends(sink.processes);
    const ObjectModel objects;
    TraceResults results;
    sink.tracker.finish(sink.processes, {std::nullopt, 7, std::nullopt}, FirstActivity(objects), results);
    return results;
  }

  std::vector<std::pair<ProcessId, std::int64_t>> ends_;
  TemporaryDirectory directory_;

 private:
  TraceWriter writer_{directory_.path() / "first"};
  std::optional<std::uint16_t> exec_;
  std::optional<std::uint16_t> signal_;
};

TEST_F(StartOfProcesses, IsMeasuredFromExecToTheFirstNodeAndTheFirstLookForWork) {
  exec(1'050, 1'000, "talker-1", 71);  // recorded 50 ns after it happened
  exec(2'000, 2'000, "other-2", 72);   // at once: shows the distance between the clocks
  write(4'500, kTalker, ros2::RclInit{7, "8.10.1"});
  write(5'000, kTalker, ros2::RclNodeInit{1, 2, "talker", "/"});
  write(6'000, kTalker, ros2::RclNodeInit{3, 4, "second", "/"});
  write(9'000, kTalker, ros2::RclcppExecutorGetNextReady{});
  write(9'500, kTalker, ros2::RclcppExecutorWaitForWork{0});
  const std::vector<StartResult> starts = results();
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_EQ(starts[0].process, "talker-1");
  EXPECT_EQ(starts[0].vpid, 71);
  EXPECT_EQ(starts[0].place, 7) << "the second process of the trace";
  EXPECT_EQ(starts[1].place, std::nullopt) << "it recorded nothing";
  EXPECT_EQ(starts[0].file, "a.launch.xml");
  EXPECT_EQ(starts[0].line, 3);
  EXPECT_EQ(starts[0].exec_ns, kEpoch + 1'000);
  EXPECT_EQ(starts[0].init_after_ns, 3'500);
  EXPECT_EQ(starts[0].node_after_ns, 4'000);
  EXPECT_EQ(starts[0].ready_after_ns, 8'000);
  EXPECT_EQ(starts[1].node_after_ns, std::nullopt) << "it has no node";
  EXPECT_EQ(starts[1].ready_after_ns, std::nullopt);
}

TEST_F(StartOfProcesses, IsUnknownWhenTheTraceBeganLater) {
  constexpr Thread kDump{71, 79, "talker-ust"};
  exec(8'000, 1'000, "talker-1", 71);
  write(8'100, kTalker, ros2::RclcppExecutorWaitForWork{0});
  write(8'200, kDump, ros2::RclNodeInit{1, 2, "talker", "/"});
  write(8'300, kTalker, ros2::RclNodeInit{3, 4, "another", "/"});
  write(8'400, kTalker, ros2::RclcppExecutorWaitForWork{0});
  const std::vector<StartResult> starts = results();
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts[0].node_after_ns, std::nullopt);
  EXPECT_EQ(starts[0].ready_after_ns, std::nullopt);
}

TEST_F(StartOfProcesses, IsUnknownBehindTheNodeWhenOnlyALaterSessionHasTheExecutors) {
  constexpr Thread kDump{71, 79, "talker-ust"};
  exec(1'000, 1'000, "talker-1", 71);
  write(2'000, kTalker, ros2::RclInit{7, "8.10.1"});
  write(3'000, kTalker, ros2::RclNodeInit{1, 2, "talker", "/"});
  TraceWriter later(directory_.path() / "later", {.identity = 2});
  later.write(0, kEpoch + 8'000, kDump, ros2::RclInit{7, "8.10.1"});
  later.write(0, kEpoch + 8'500, kTalker, ros2::RclcppExecutorGetNextReady{});
  later.finish();
  const std::vector<StartResult> starts = results();
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts[0].init_after_ns, 1'000);
  EXPECT_EQ(starts[0].node_after_ns, 2'000);
  EXPECT_EQ(starts[0].ready_after_ns, std::nullopt);
}

TEST_F(StartOfProcesses, StaysAsItWasWhenAnotherSessionBegins) {
  constexpr Thread kDump{71, 79, "talker-ust"};
  exec(1'000, 1'000, "talker-1", 71);
  write(3'000, kTalker, ros2::RclNodeInit{1, 2, "talker", "/"});
  write(4'000, kTalker, ros2::RclcppExecutorWaitForWork{0});
  write(5'000, kDump, ros2::RclNodeInit{1, 2, "talker", "/"});
  const std::vector<StartResult> starts = results();
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts[0].node_after_ns, 2'000);
  EXPECT_EQ(starts[0].ready_after_ns, 3'000);
}

TEST_F(StartOfProcesses, TheFirstSignalThatAsksAProcessToEndIsItsEnd) {
  exec(1'000, 1'000, "talker-1", 71);
  exec(2'000, 2'000, "other-2", 72);
  write(3'000, kTalker, ros2::RclNodeInit{1, 2, "talker", "/"});
  signal(4'000, "talker-1", SIGUSR1);
  signal(5'000, "talker-1", SIGINT);
  signal(9'000, "talker-1", SIGTERM);
  results();
  ASSERT_EQ(ends_.size(), 1u);
  EXPECT_EQ(ends_[0].first, 1u) << "the second process of the trace";
  EXPECT_EQ(ends_[0].second, kEpoch + 5'000);
}

TEST_F(StartOfProcesses, IsEmptyWithoutTheLauncher) {
  write(5'000, kTalker, ros2::RclNodeInit{1, 2, "talker", "/"});
  EXPECT_TRUE(results().empty());
}

TEST_F(StartOfProcesses, IsFollowedByWhatTheLauncherSawAndDid) {
  exec(1'000, 1'000, "talker-1", 71);
  change("condition", 5'000, "condition", "on_late of node /talker above 5ms",
         "a callback of /talker took 9.00 ms, more than 5 ms");
  change("scheduling", 6'000, "process", "talker-1", "nice 5");
  signal(8'000, "talker-1", SIGINT);
  std::vector<std::string> events;
  for (const LauncherEventResult& event : all_results().launcher_events) {
    events.push_back(fmt::format("{} {} {}: {} [{}:{}] {}", event.time_ns - kEpoch, event.kind_name(), event.subject,
                                 event.what, event.file, event.line, event.is_ordinary()));
  }
  EXPECT_THAT(events, ::testing::ElementsAre(
                          "5000 condition on_late of node /talker above 5ms: a callback of /talker took 9.00 ms, "
                          "more than 5 ms [a.launch.xml:5] false",
                          "6000 scheduling talker-1: nice 5 [a.launch.xml:5] false",
                          "8000 signal talker-1: SIGINT [a.launch.xml:3] true"));
}

TEST(LauncherEvent, IsToldAsASentence) {
  using Told = LauncherEventResult::Kind;
  const auto sentence = [](Told kind, const char* what) {
    return LauncherEventResult{.kind = kind, .subject = "talker-1", .what = what}.sentence();
  };
  EXPECT_EQ(sentence(Told::kCondition, "as the condition says"), "as the condition says");
  EXPECT_EQ(sentence(Told::kScheduling, "nice 5"), "its threads get processors by nice 5");
  EXPECT_EQ(sentence(Told::kScheduling, ""), "its threads get processors as before");
  EXPECT_EQ(sentence(Told::kSignal, "SIGINT"), "was sent SIGINT");
  EXPECT_EQ(sentence(Told::kExit, "SIGSEGV"), "ended, SIGSEGV");
  EXPECT_EQ(sentence(Told::kRespawn, "exit code 1"), "ended, exit code 1, and is started again");
  EXPECT_EQ(sentence(Told::kCut, "ros2:rmw_take"),
            "no longer recorded, because recording cost too much: ros2:rmw_take");
}

}  // namespace
}  // namespace tracing
