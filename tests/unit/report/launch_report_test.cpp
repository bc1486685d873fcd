// SPDX-License-Identifier: Apache-2.0
// Runs the program `launch-report` on traces.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/support/trace_writer/trace_writer.hpp"
#include "tests/unit/report/launch_report_case.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using testing::TemporaryDirectory;
using testing::TraceWriter;

TEST_F(LaunchReport, HasColoursWhenTheVariableOfTheNodesSaysSo) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();

  EXPECT_THAT(launch_report(path_).out, Not(HasSubstr("\033[")));
  ::setenv("RCUTILS_COLORIZED_OUTPUT", "1", 1);
  EXPECT_THAT(launch_report(path_).out, HasSubstr("\033["));
  ::unsetenv("RCUTILS_COLORIZED_OUTPUT");
}

TEST_F(LaunchReport, PrintsTheReportOfPingAndPong) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();

  const Outcome outcome = launch_report(path_);

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "Trace      " + path_ +
                             R"(
Recorded   2026-01-01 00:00:00.000000 UTC, for 507 ms
Events     57 of 2 processes
Losses     no events lost

Worth a look
  nothing stands out

Chains                                   count     p50     p99     max  reaction p99  age max
  /ping -> /pong -> /ping  timer 500 ms      1  342 us  342 us  342 us             -   342 us

Callbacks                             rate  count      p50      p99      max  jitter  missed    load
  /pong, subscription /ping              -      1  80.0 us  80.0 us  80.0 us       -       -  0.02 %
  /ping, timer 500 ms  Ping::?           -      1  60.0 us  60.0 us  60.0 us       -       -  0.01 %
  /ping, subscription /pong  Ping::?     -      1  30.0 us  30.0 us  30.0 us       -       -  0.01 %

Topics   rate  sent  received  dropped     p50     p99     max
  /ping     -     1         1        -  160 us  160 us  160 us
  /pong     -     1         1        -  120 us  120 us  120 us

Executors       busy  callbacks  longest busy                   in
  /ping [71]  0.02 %          2       75.0 us  /ping, timer 500 ms
  /pong [72]  0.02 %          1             -
)");
}

TEST_F(LaunchReport, FailsOnLostEventsIfThatIsAskedFor) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.write(0, testing::kPingPongBegin + 600'000'000, testing::kPing, ros2::RclTake{1});
  writer.finish();
  EXPECT_EQ(launch_report(path_).exit_code, 0);
  for (const char* output : {"", " --json", " --summary"}) {
    const Outcome outcome = launch_report(path_ + " --fail-on incomplete" + output);
    EXPECT_EQ(outcome.exit_code, 3) << output;
    EXPECT_THAT(outcome.err, HasSubstr("launch report: error: the trace is incomplete: 12 events lost")) << output;
  }
  EXPECT_EQ(launch_report(path_ + " --fail-on incomplete --html " + path_ + "/page.html").exit_code, 3);
}

TEST_F(LaunchReport, DoesNotFailOnAWholeTrace) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();
  EXPECT_EQ(launch_report(path_ + " --fail-on incomplete").exit_code, 0);
  std::ofstream(directory_.path() / "verdict.json") << R"json({"absent": ["camera [12] was never registered"]})json";
  EXPECT_EQ(launch_report(path_ + " --fail-on incomplete").exit_code, 3);
}

TEST_F(LaunchReport, WhatTheVerdictMissesIsRepeated) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();
  std::ofstream(directory_.path() / "verdict.json")
      << R"json({"absent": ["camera [12] was never registered with the session daemon: 4 events that it fired are missing"],
                 "event_cost": {"ns": 500}, "processes": [{"name": "ping", "pid": 71, "events": 30,
                 "tracing": {"seconds": 0.000015, "processor_share": 0.00003, "ns_per_callback": 7500}}]})json";

  const Outcome outcome = launch_report(path_);

  EXPECT_NE(
      outcome.out.find("\nNot there\n  camera [12] was never registered with the session daemon: 4 events that it "
                       "fired are missing\n\nWorth a look\n"),
      std::string::npos)
      << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("\nCost       28.5 us of 500 ns for each event, 0.0056 % of a processor\n"));
  EXPECT_THAT(
      launch_report(path_ + " --all").out,
      HasSubstr("\nCost of tracing                           events        time  of a processor for each callback\n"
                "  ping [71]                                   30     15.0 us         0.003 %           7.50 us\n"));
  const nlohmann::json cost = nlohmann::json::parse(launch_report(path_ + " --json").out)["cost"];
  EXPECT_EQ(cost["ns_per_event"], 500.0);
  EXPECT_EQ(cost["processes"][0]["vpid"], 71);
}

// A stream file is gone together with its index.
TEST_F(LaunchReport, WhatTheVerdictCountsAndTheTraceLacksIsDamage) {
  const fs::path trace = directory_.path() / "ust/uid/0/64-bit";
  TraceWriter writer(trace);
  write_ping_pong(writer);
  writer.finish();
  TraceReader reader(trace);
  reader.next();
  const std::uint64_t bytes = reader.content_bytes().value_or(0);
  const auto write_verdict = [this](std::uint64_t recorded) {
    std::ofstream(directory_.path() / "verdict.json")
        << R"json({"damage": "", "channels": [{"domain": "ust", "counted_by": "packets", "bytes": )json" << recorded
        << "}]}";
  };
  write_verdict(bytes + 1000);
  const Outcome outcome = launch_report(path_);
  const std::string what = fmt::format("lacks 1000 of the {} bytes that the session recorded", bytes + 1000);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr(what + "\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nDamaged    "));
  EXPECT_THAT(
      outcome.out,
      HasSubstr("\nLosses     unknown, as a part of the trace is missing; results marked with * may be wrong\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n  /pong, subscription /ping *"));
  EXPECT_THAT(outcome.err, HasSubstr(what));
  EXPECT_EQ(launch_report(path_ + " --summary").exit_code, 1);
  write_verdict(bytes);
  EXPECT_EQ(launch_report(path_).exit_code, 0);
}

// Each domain has its own size: what the kernel recorded does not stand for what processes recorded.
TEST_F(LaunchReport, ADomainThatLacksBytesIsDamageWhateverAnotherHas) {
  const fs::path trace = directory_.path() / "ust/uid/0/64-bit";
  TraceWriter writer(trace);
  write_ping_pong(writer);
  writer.finish();
  TraceReader reader(trace);
  reader.next();
  const std::uint64_t bytes = reader.content_bytes().value_or(0);
  std::ofstream(directory_.path() / "verdict.json") << fmt::format(
      R"json({{"damage": "", "channels": [{{"domain": "ust", "counted_by": "packets", "bytes": {}}},
                                       {{"domain": "kernel", "counted_by": "kernel recorder", "bytes": 500}}]}})json",
      bytes);
  EXPECT_THAT(launch_report(path_).err,
              HasSubstr("lacks 500 of the 500 bytes that the session recorded in domain kernel"));

  std::ofstream(directory_.path() / "verdict.json")
      << fmt::format(R"json({{"reasons": ["a signal"], "damage": "", "bytes": {{"ust": {}}}}})json", bytes + 7);
  const Outcome snapshot = launch_report(path_ + " --fail-on incomplete");
  EXPECT_THAT(snapshot.err, HasSubstr(fmt::format("lacks 7 of the {} bytes that the session recorded", bytes + 7)));
  EXPECT_NE(snapshot.exit_code, 0);

  std::ofstream(directory_.path() / "verdict.json") << "{";
  EXPECT_THAT(launch_report(path_).err, HasSubstr("verdict.json' is broken, so nothing tells what else is missing"));
}

TEST_F(LaunchReport, WhatWasOverwrittenOrOnlyTheDaemonCountedIsSaid) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();
  std::ofstream(directory_.path() / "verdict.json")
      << R"json({"absent": [], "damage": "", "cut_short": true, "discarded_events": 3, "lost_packets": 0, "channels": [
                 {"channel": "a", "before_first_packet": {"why": "overwritten, as asked", "packets": 2, "events": 1}},
                 {"channel": "b", "before_first_packet": {"why": "overwritten, as asked", "packets": 2, "events": null}},
                 {"channel": "c", "before_first_packet": {"why": "removed", "packets": 1, "events": null}},
                 {"channel": "d"}]})json";
  const std::string losses =
      "3 events lost, 1 event overwritten, as asked, 2 packets overwritten, as asked, 1 packet cleared or moved away\n";
  EXPECT_THAT(launch_report("--summary " + path_ + " " + path_).out, ::testing::EndsWith(", " + losses));
  const Outcome outcome = launch_report(path_);
  EXPECT_THAT(outcome.out, HasSubstr("\nLosses     " + losses));
  EXPECT_THAT(outcome.out, HasSubstr("\nNot there\n  the last events were not waited for\n"));
  EXPECT_EQ(nlohmann::json::parse(launch_report(path_ + " --json").out)["overwritten"],
            nlohmann::json({"1 event overwritten, as asked", "2 packets overwritten, as asked",
                            "1 packet cleared or moved away"}));
}

TEST_F(LaunchReport, KnowsTheChainsOfTheLaunchFile) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();
  std::ofstream(directory_.path() / "chains.json") << R"json({"chains": [
      {"name": "round", "nodes": ["/ping", "/pong", "/ping"], "budget_ms": 0.3},
      {"name": "other", "nodes": ["/pong", "/nobody"]}]})json";
  const Outcome outcome = launch_report(path_);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out,
              HasSubstr("\nNot there\n  chain 'other': no callbacks were seen that cause one another in this "
                        "order\n"));
  EXPECT_THAT(
      outcome.out,
      HasSubstr("  Over budget       round: /ping -> /pong -> /ping\n                    1 of 1 took longer than the "
                "budget of 300 us, at most 342 us\n"));
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("round: /ping -> /pong -> /ping .* 300 us +1 "));
}

TEST_F(LaunchReport, GoesOnWithoutAFileOfChainsThatIsDamaged) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.finish();
  std::ofstream(directory_.path() / "chains.json") << "{";
  const Outcome outcome = launch_report(path_);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "launch report: warning: the chains in '" + path_ +
                             "/chains.json' cannot be read: it has no list 'chains'\n");
  EXPECT_THAT(outcome.out, HasSubstr("/ping -> /pong -> /ping"));
}

TEST_F(LaunchReport, SummarisesInOneLine) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.write(0, testing::kPingPongBegin + 600'000'000, testing::kPing, ros2::RclTake{1});
  writer.finish();
  const Outcome outcome = launch_report("--summary " + path_);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "58 events, 2 processes, 12 events lost; doubtful: ping [71], pong [72]\n");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(LaunchReport, GivesStreamsRelativeToTheDirectory) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  write_ping_pong(writer);
  writer.end_packet(0);
  writer.discard_events(0, 12);
  writer.write(0, testing::kPingPongBegin + 600'000'000, testing::kPing, ros2::RclTake{1});
  writer.finish();
  for (const std::string& given : {path_, path_ + "/", "$(realpath --relative-to=. " + path_ + ")"}) {
    EXPECT_THAT(launch_report("--events " + given).out, HasSubstr("\n  ust/uid/0/64-bit/ros2_0  "));
  }
}

TEST_F(LaunchReport, PrintsJson) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.finish();
  const Outcome outcome = launch_report(path_ + " --json");
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["events"], 57);
  EXPECT_EQ(json["error"], nullptr);
  EXPECT_EQ(json["callbacks"].size(), 3u);
  EXPECT_EQ(json["topics"][0]["latency"]["mean_ns"], 150'000.0);
}

TEST_F(LaunchReport, ReportsWhatComesBeforeDamageAndFails) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  constexpr std::uint16_t kUndeclared = 999;
  writer.write_raw(0, testing::kPingPongBegin + 600'000'000, testing::kPing, kUndeclared, "");
  writer.finish();
  const Outcome outcome = launch_report(path_);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, StartsWith("launch report: error: the trace '" + path_ + "' is damaged or ends early: "));
  EXPECT_THAT(outcome.out, HasSubstr("Damaged    the trace '" + path_ + "' is damaged or ends early: "));
  EXPECT_THAT(outcome.out, HasSubstr("Events     57 of 2 processes\n"));
}

// Both sessions have recorded the same system.
TEST_F(LaunchReport, ReadsSeveralDirectoriesAsOneTrace) {
  for (const std::uint8_t identity : {1, 2}) {
    TraceWriter writer(directory_.path() / std::to_string(identity), {.identity = identity});
    write_ping_pong(writer);
    writer.finish();
  }
  const Outcome outcome = launch_report("--summary " + path_ + "/1 " + path_ + "/2 " + path_ + "/1/");
  EXPECT_EQ(outcome.out, "57 events, 2 processes, none lost\n");
  EXPECT_EQ(launch_report("--summary " + path_).out, outcome.out);
}

TEST_F(LaunchReport, ShowsWhatIsChosen) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.finish();
  EXPECT_THAT(launch_report(path_ + " --node /pong").out,
              AllOf(HasSubstr("\n  /pong, subscription /ping "), Not(HasSubstr("\n  /ping, timer"))));
  EXPECT_THAT(launch_report(path_ + " --top 1").out, HasSubstr("\nCallbacks, 1 of 3 "));
  EXPECT_THAT(launch_report(path_ + " --chain /ping /pong").out, HasSubstr("\n    /ping on its way "));
  EXPECT_THAT(launch_report(path_ + " --events").out, HasSubstr("\n  ros2:callback_end "));
  EXPECT_THAT(launch_report(path_ + " --all").out, HasSubstr("\nWays of messages "));
}

TEST_F(LaunchReport, SaysWhatNodesAndTopicsThereAreInstead) {
  TraceWriter writer(directory_.path());
  write_ping_pong(writer);
  writer.finish();
  const Outcome node = launch_report(path_ + " --node '/camera*'");
  EXPECT_EQ(node.exit_code, 0);
  EXPECT_EQ(node.err, "launch report: warning: no node is called '/camera*'; what was read has /ping, /pong\n");
  EXPECT_EQ(launch_report(path_ + " --topic ping").err,
            "launch report: warning: no topic is called 'ping'; what was read has /ping, /pong; did you mean "
            "'/ping'?\n");
  EXPECT_EQ(launch_report(path_ + " --node '/p*' --topic /pong").err, "");
}

TEST_F(LaunchReport, FailsWithoutATrace) {
  for (const char* option : {"", " --json", " --summary"}) {
    const Outcome outcome = launch_report(path_ + option);
    EXPECT_EQ(outcome.exit_code, 1) << option;
    EXPECT_EQ(outcome.out, "") << option;
    EXPECT_EQ(outcome.err, "launch report: error: '" + path_ +
                               "' is not a trace: neither it nor a directory below it has a file 'metadata'\n"
                               "      = help: LTTng writes no trace when no traced process ran during the session, and "
                               "none before 'snapshot record'\n")
        << option;
  }
}

TEST_F(LaunchReport, RefusesWrongArguments) {
  EXPECT_EQ(launch_report("").exit_code, 2);
  EXPECT_EQ(launch_report("--unknown " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--json --summary " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--json --html x.html " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--summary --dot x.dot " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--sort size " + path_).exit_code, 2);
  EXPECT_EQ(launch_report("--chain /a " + path_).exit_code, 2);
  const Outcome top = launch_report("--top -1 " + path_);
  EXPECT_EQ(top.exit_code, 2);
  EXPECT_EQ(top.err,
            "launch report: error: --top: '-1' is below 0\n"
            "      = help: see 'launch report --help'\n");
  const Outcome empty = launch_report(path_ + " --csv " + path_ + "/csv --from +5 --to +2");
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_EQ(empty.err,
            "launch report: error: --to: '+2' is not after --from '+5'\n"
            "      = help: see 'launch report --help'\n");
}

TEST_F(LaunchReport, RefusesWhatTheOutputWouldPassOver) {
  for (const char* const option :
       {"--top 3", "--sort max", "--node /ping", "--topic /ping", "--chain /ping /pong", "--events"}) {
    const std::string name = std::string(option).substr(0, std::string(option).find(' '));
    for (const auto& [output, what] :
         {std::pair("--json", "--json"), std::pair("--summary", "--summary"), std::pair("--html x.html", "a file")}) {
      const Outcome result = launch_report(std::string(output) + " " + path_ + " " + option);
      EXPECT_EQ(result.exit_code, 2);
      EXPECT_EQ(result.err.substr(0, result.err.find('\n')),
                "launch report: error: " + name + ": is for the text, and " + what + " has everything");
    }
  }
  EXPECT_EQ(launch_report("--json --all " + path_).exit_code, 1) << "it counts there, and this is no trace yet";
}

TEST_F(LaunchReport, ExplainsItself) {
  const Outcome outcome = launch_report("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("--summary"));
}

TEST_F(LaunchReport, CountsWhatIsRecordedOfEachProcessForTheVerdict) {
  TraceWriter writer(directory_.path() / "ust/uid/0/64-bit");
  const testing::Thread thread{.vpid = 12, .vtid = 12, .procname = "talker"};
  writer.write(0, 1000, thread, ros2::RclNodeInit{1, 2, "talker", "/robot"});
  writer.write(0, 1100, thread, ros2::RclNodeInit{3, 4, "other", "/"});
  writer.write(0, 1200, {.vpid = 13, .vtid = 14, .procname = "x"}, ros2::RclTake{1});
  writer.finish();
  const Outcome outcome = launch_report("--recorded " + path_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            R"({"processes":[{"vpid":12,"name":"talker","seconds":1e-07,"nodes":["/other","/robot/talker"],)"
            R"("events":{"ros2:rcl_node_init":2}},)"
            R"({"vpid":13,"name":"x","seconds":0.0,"nodes":[],"events":{"ros2:rcl_take":1}}]})"
            "\n");
}

}  // namespace
}  // namespace tracing
