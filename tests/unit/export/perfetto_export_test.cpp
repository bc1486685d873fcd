// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"

namespace tracing {
namespace {

using nlohmann::json;

json exported(const TracedSystem& system) {
  const testing::TemporaryDirectory directory;
  export_perfetto(system, directory.path() / "trace.json");
  std::ifstream file(directory.path() / "trace.json");
  return json::parse(file);
}

std::vector<json> events_of(const json& trace, const std::string& phase) {
  std::vector<json> events;
  for (const json& event : trace["traceEvents"]) {
    if (event["ph"] == phase) {
      events.push_back(event);
    }
  }
  return events;
}

TEST(PerfettoExport, HasEverythingOfACycle) {
  const json trace = exported(testing::traced_example(1));
  EXPECT_EQ(trace["otherData"],
            json::parse(R"json({"begin_ns":1767225599970000000,"directory":"/traces/example","lost_events":0})json"));

  std::map<std::string, int> phases;
  for (const json& event : trace["traceEvents"]) {
    ++phases[event["ph"]];
  }
  EXPECT_EQ(phases, (std::map<std::string, int>{
                        {"M", 7}, {"i", 9}, {"X", 5}, {"s", 2}, {"f", 2}, {"C", 2}, {"b", 5}, {"e", 5}}));

  EXPECT_EQ(events_of(trace, "M")[1]["args"]["name"], "sensor");
  const std::vector<json> slices = events_of(trace, "X");
  EXPECT_EQ(slices[0], json::parse(R"json({"ph":"X","cat":"callback","pid":101,"tid":101,"ts":50000.0,"dur":200.0,
      "name":"timer 10 ms","args":{"node":"/sensor","symbol":"Sensor::on_timer()"
}
})json"));
  EXPECT_EQ(slices[1]["name"], "subscription /scan");
  EXPECT_EQ(slices[3], json::parse(R"json({"ph":"X","cat":"publish","name":"publish /scan","pid":101,"tid":101,
      "ts":50095.0,"dur":5.0})json"));
  EXPECT_EQ(
      events_of(trace, "s")[0],
      json::parse(R"json({"ph":"s","cat":"message","name":"/scan","id":"0x0","pid":101,"tid":101,"ts":50095.0})json"));
  EXPECT_EQ(
      events_of(trace, "f")[0],
      json::parse(
          R"json({"ph":"f","bp":"e","cat":"message","name":"/scan","id":"0x0","pid":102,"tid":102,"ts":50300.0})json"));
  EXPECT_EQ(events_of(trace, "C")[0], json::parse(R"json({"ph":"C","name":"latency of /scan","pid":102,"tid":102,
      "ts":50300.0,"args":{"us":200.0}})json"));
  EXPECT_EQ(events_of(trace, "b")[4],
            json::parse(R"json({"ph":"b","cat":"lifecycle","id":"0x2","name":"/display active",
      "pid":103,"tid":103,"ts":39500.0})json"));
  EXPECT_EQ(events_of(trace, "i")[0],
            json::parse(R"json({"ph":"i","s":"p","cat":"start","name":"exec","pid":101,"tid":101,
      "ts":0.0,"args":{"process":"sensor-1","file":"/examples/system.launch.xml","line":3}})json"));
}

TEST(PerfettoExport, HasARowForWhatAThreadDidOnTheMachine) {
  const json trace = exported(testing::traced_example(20, testing::ExampleEvents::kRosAndScheduler));
  EXPECT_EQ(events_of(trace, "M").back(), json::parse(R"json({"ph":"M","name":"thread_name","pid":102,"tid":2000000001,
      "args":{"name":"thread 102 on the machine"}})json"));
  std::vector<json> states;
  for (const json& slice : events_of(trace, "X")) {
    if (slice["cat"] == "state") {
      states.push_back(slice);
    }
  }
  EXPECT_EQ(*std::find_if(states.begin(), states.end(), [](const json& one) { return one["args"].size() == 2; }),
            json::parse(R"json({"ph":"X","cat":"state","name":"runnable","pid":102,"tid":2000000001,"ts":241600.0,
      "dur":3500.0,"args":{"cpu":1,"ran_instead":"stress [90]"}})json"));
  std::vector<json> counters;
  for (const json& counter : events_of(trace, "C")) {
    if (counter["name"] == "threads that wait for a processor") {
      counters.push_back(counter);
    }
  }
  EXPECT_EQ(counters.back()["args"], json::parse(R"json({"threads":0})json"));
  EXPECT_EQ(counters.back()["ts"], 245100.0);
}

// Perfetto connects an arrow with the slice that holds its time.
TEST(PerfettoExport, EndsOfFlowsLieWithinSlices) {
  const json trace = exported(testing::traced_example(60));
  const std::vector<json> slices = events_of(trace, "X");
  int ends = 0;
  for (const char* phase : {"s", "f"}) {
    for (const json& flow : events_of(trace, phase)) {
      ++ends;
      EXPECT_TRUE(std::any_of(slices.begin(), slices.end(), [&flow](const json& slice) {
        const double begin = slice["ts"];
        const double time = flow["ts"];
        return slice["pid"] == flow["pid"] && slice["tid"] == flow["tid"] && begin <= time &&
               time <= begin + slice["dur"].get<double>();
      })) << flow;
    }
  }
  EXPECT_EQ(ends, 2 * 119);
}

// Perfetto takes what stands behind the point of a negative time for positive, and in some releases displayTimeUnit for
// the unit of all times.
TEST(PerfettoExport, HasNoNegativeTimesAndNoUnit) {
  const json trace = exported(testing::traced_example(3));
  EXPECT_FALSE(trace.contains("displayTimeUnit"));
  for (const json& event : trace["traceEvents"]) {
    EXPECT_GE(event.value("ts", 0.0), 0) << event;
  }
}

TEST(PerfettoExport, KeepsProcessesOfTwoMachinesApart) {
  TracedSystem system;
  system.timeline.processes = {{71, "ping", "left", 0}, {71, "ping", "right", 1}};
  system.results.starts.resize(2);
  for (std::size_t id = 0; id < 2; ++id) {
    system.results.starts[id].vpid = 71;
    system.results.starts[id].place = id;
  }
  const std::vector<json> starts = events_of(exported(system), "i");
  EXPECT_EQ(starts[0]["pid"], 71);
  EXPECT_EQ(starts[1]["pid"], 1'000'000'071);
  const std::vector<json> names = events_of(exported(system), "M");
  EXPECT_EQ(names[0]["pid"], 71);
  EXPECT_EQ(names[0]["args"]["name"], "left ping");
  EXPECT_EQ(names[1]["pid"], 1'000'000'071);
  EXPECT_EQ(names[1]["args"]["name"], "right ping");
}

TEST(PerfettoExport, HasWhatTheLauncherDidOverAllProcesses) {
  using Kind = LauncherEventResult::Kind;
  TracedSystem system;
  system.timeline.begin_ns = 5'000;
  system.results.launcher_events = {{6'000, Kind::kScheduling, "talker-1", "nice 5", "a.launch.xml", 3},
                                    {7'000, Kind::kExit, "talker-1", "SIGINT", "a.launch.xml", 2}};
  const std::vector<json> events = events_of(exported(system), "i");
  ASSERT_EQ(events.size(), 1u) << "each launch has the other one";
  EXPECT_EQ(events[0]["name"], "talker-1: its threads get processors by nice 5");
  EXPECT_EQ(events[0]["s"], "g");
  EXPECT_EQ(events[0]["ts"], 1.0);
  EXPECT_EQ(events[0]["args"], json({{"kind", "scheduling"}, {"file", "a.launch.xml"}, {"line", 3}}));
}

TEST(PerfettoExport, IsValidForAnEmptyTraceAndForOddTexts) {
  TracedSystem system;
  EXPECT_EQ(exported(system)["traceEvents"], json::array());
  system.timeline.processes = {{1, "a\"b\\c\n\xff", "", {}}};
  EXPECT_EQ(exported(system)["traceEvents"][0]["args"]["name"], "a\"b\\c\n\xef\xbf\xbd");
}

}  // namespace
}  // namespace tracing
