// SPDX-License-Identifier: Apache-2.0
// The cost and the losses of a trace in the verdict; the limit of the cost; deadlines.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/sysinfo.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using nlohmann::json;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class TraceCost : public testing::Test {
 protected:
  std::string write(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return path.string();
  }

  json verdict() const { return json::parse(read_file(sandbox_.trace_directory() / "run" / "verdict.json")); }

  static void expect_no_counters_left() {
    for (const auto& entry : fs::directory_iterator("/dev/shm")) {
      EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("launch-event-counters")));
    }
  }

  // traced_load is the load of the benchmark of traces.
  static std::string load(const std::string& name, int events_per_second, int seconds) {
    return "<executable name=\"" + name + "\" output=\"screen\" cmd=\"" TRACED_NODE " " +
           std::to_string(events_per_second) + " " + std::to_string(seconds) + "\"/>\n";
  }

  // The environment has no cache directory of its own.
  static json measurements() {
    return json::parse(read_file(fs::path(std::getenv("HOME")) / ".cache/launch/event_cost.json"));
  }

  void SetUp() override { unsetenv("XDG_CACHE_HOME"); }

  Sandbox sandbox_;
};

TEST_F(TraceCost, TheVerdictSaysExactlyHowManyEventsEachProcessLost) {
  const std::string file = write(
      "<trace session-name=\"run\" subbuffer-size-ust=\"4096\" subbuffer-count-ust=\"2\" "
      "read-timer-ust=\"300000\"/>\n" +
      load("one", 40000, 1) + load("two", 80000, 1));
  const CommandResult result = run_command({LAUNCH_PROGRAM, file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;

  EXPECT_THAT(
      result.out,
      HasSubstr("[WARNING] [launch.trace]: 2 processes may fire 4000 events a second, more than 2 sub-buffers of "
                "4096 bytes for each of " +
                std::to_string(get_nprocs_conf()) +
                " processors hold on a busy machine: events may be lost; subbuffers=\"auto\" sizes them\n"));

  const json told = verdict();
  EXPECT_GT(told["discarded_events"], 1000) << "the buffers are small enough to lose events";
  // The launcher does not count its own events, which may be lost as well.
  const bool all_told = told["lost_by_process"]["unattributed"] == 0;
  EXPECT_EQ(told["lost_by_process"]["method"], all_told ? "exact" : "estimate");
  ASSERT_THAT(told["processes"], SizeIs(2));

  std::map<std::int64_t, std::uint64_t> recorded;  // the events that another reader counts
  for (const RecordedEvent& event : read_trace(sandbox_.trace_directory() / "run").events) {
    if (event.name.starts_with("ros2:")) {
      ++recorded[event.vpid];
    }
  }
  std::uint64_t lost = told["lost_by_process"]["unattributed"];
  for (const json& process : told["processes"]) {
    EXPECT_EQ(process["name"], "traced_load");
    const std::uint64_t fired = process["events"];
    EXPECT_THAT(result.out, ContainsRegex("\\] " + std::to_string(fired) + "\n")) << "as the program itself says";
    EXPECT_EQ(process["lost"], fired - recorded[process["pid"]]);
    lost += process["lost"].get<std::uint64_t>();
  }
  EXPECT_EQ(lost, told["discarded_events"]);
  EXPECT_THAT(result.out,
              HasSubstr(all_told ? "lost by process: traced_load [" : "lost by process, estimated: traced_load ["));
  expect_no_counters_left();
}

TEST_F(TraceCost, ALaunchWithoutLossesSaysWhatTracingCost) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\"/>\n" + load("one", 2000, 1))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  const double ns = told["event_cost"]["ns"];
  EXPECT_GT(ns, 10);
  const json& process = told["processes"].at(0);
  EXPECT_EQ(process["lost"], 0);
  EXPECT_EQ(process["callbacks"].get<std::uint64_t>(), (process["events"].get<std::uint64_t>() - 93) / 10)
      << "93 of initialisation, and ten for each message";
  EXPECT_NEAR(process["tracing"]["seconds"], process["events"].get<double>() * ns / 1e9, 1e-9);
  EXPECT_GT(process["tracing"]["own_share"], 0);
  EXPECT_THAT(result.out, ContainsRegex("estimated cost of tracing: 0\\.[0-9]+ s of processor time, .* % of a "
                                        "processor; most in traced_load \\[[0-9]+\\], .* % of its own processor "
                                        "time, .* µs for each callback \\([0-9]+ ns for each event\\)"));

  const json kept = measurements();
  ASSERT_THAT(kept, SizeIs(1)) << "measured once";
  EXPECT_EQ(kept[0]["ns_per_event"], told["event_cost"]["ns"]);
}

TEST_F(TraceCost, CalibrateMeasuresAgain) {
  const CommandResult result = run_command({LAUNCH_PROGRAM, "trace", "calibrate"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              ContainsRegex("^an event with procname vpid vtid costs [0-9]+\\.[0-9] ns on .*, LTTng 2\\..*\n"
                            "kept in .*/\\.cache/launch/event_cost\\.json\n$"));
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "trace", "calibrate", "-c"}).exit_code, 0);
  EXPECT_EQ(run_command({LAUNCH_PROGRAM, "trace", "calibrate"}).exit_code, 0);
  EXPECT_THAT(measurements(), SizeIs(2)) << "one for each set of context fields";
  EXPECT_THAT(run_command({LAUNCH_PROGRAM, "trace", "list"}).out, testing::Not(HasSubstr("calibration")));
}

TEST_F(TraceCost, ClassesOfEventsAreDroppedWhileTheBudgetIsExceeded) {
  const std::string file = write(
      "<trace session-name=\"run\" max-overhead=\"0.001%\" drop-order=\"layers callbacks executor\" "
      "launch-events=\"false\"/>\n" +
      load("one", 20000, 100));
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("there is nothing left to drop")) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
  EXPECT_THAT(run.out(),
              ContainsRegex("\\[WARNING\\] \\[launch.trace\\]: [0-9]+ events a second cost .* % of a processor, more "
                            "than max-overhead 0.001 %: events 'layers' are no longer recorded: "
                            "ros2:rclcpp_publish ros2:rcl_publish"));

  std::vector<std::string> dropped;
  std::map<std::string, std::int64_t> last;  // time stamps, by event
  std::map<std::string, int> counts;
  for (const RecordedEvent& event : read_trace(sandbox_.trace_directory() / "run").events) {
    last[event.name] = event.timestamp;
    ++counts[event.name];
    if (event.name != "launch:cut") {
      continue;
    }
    dropped.push_back(event.text("event_class"));
    EXPECT_GT(event.number("rate"), 1000u);
  }
  EXPECT_THAT(dropped, ElementsAre("layers", "callbacks", "executor"));
  // The run may end before the next cycle of the load.
  EXPECT_GE(last["ros2:rmw_publish"], last["ros2:rcl_publish"]) << "not in drop-order";
  EXPECT_EQ(counts["ros2:rcl_init"], 1);
  EXPECT_EQ(counts["ros2:rcl_publisher_init"], 10);

  const json told = verdict();
  EXPECT_TRUE(told["complete"].get<bool>()) << "what is dropped on purpose is not lost";
  ASSERT_THAT(told["cuts"], SizeIs(3));
  EXPECT_EQ(told["cuts"][0]["class"], "layers");
  EXPECT_GT(told["cuts"][0]["rate"], told["cuts"][1]["rate"]) << "what is left, by estimate";
  EXPECT_GT(told["cuts"][1]["rate"], told["cuts"][2]["rate"]);
  EXPECT_GT(told["cuts"][2]["rate"], 1000);
  EXPECT_THAT(
      run.out(),
      HasSubstr("trace is complete but for what was asked to be dropped: dropped to keep to max-overhead: layers, "
                "callbacks, executor"));
}

TEST_F(TraceCost, NothingIsDroppedWithinTheBudget) {
  const CommandResult result = run_command(
      {LAUNCH_PROGRAM, write("<trace session-name=\"run\" max-overhead=\"90%\"/>\n" + load("one", 2000, 2))});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_FALSE(verdict().contains("cuts"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("max-overhead")));
}

TEST_F(TraceCost, WhatTheLimitIsAndWhatIsDroppedIsChecked) {
  const auto error = [this](const std::string& attributes) {
    const CommandResult result =
        run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\" " + attributes + "/>")});
    EXPECT_EQ(result.exit_code, 1);
    return result.err;
  };
  EXPECT_THAT(error("max-overhead=\"2\""),
              HasSubstr("max-overhead is expected to be a percentage of a processor like 2%, got '2'"));
  EXPECT_THAT(error("max-overhead=\"-2%\""), HasSubstr("got '-2%'"));
  EXPECT_THAT(error("max-overhead=\"2%\" drop-order=\"executer\""),
              HasSubstr("there is no class of events 'executer'"));
  EXPECT_THAT(error("max-overhead=\"2%\" events-ust=\"ros2:rcl_init\""),
              HasSubstr("tracing setup failed: max-overhead has no events that it may drop"));
  EXPECT_THAT(run_command({LAUNCH_PROGRAM, "trace", "list"}).out, testing::Not(HasSubstr("run")));
}

TEST_F(TraceCost, ALateCallbackAndALateMessageAreInSnapshots) {
  const std::string file = write(
      "<trace session-name=\"run\" snapshot-on-late-callback=\"20\" snapshot-on-late-message=\"60000.5\" "
      "snapshot-limit=\"3\"/>\n<executable name=\"node\" cmd=\"" TRACE_COST_NODE " 30\"/>");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file}});
  ASSERT_TRUE(run.wait_for_output("a message was taken after more than 60000.5 ms")) << run.out() << run.err();
  EXPECT_THAT(run.out(), HasSubstr("a callback took more than 20 ms"));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);

  std::vector<RecordedEvent> late;
  fs::path newest;
  for (const auto& entry : fs::directory_iterator(sandbox_.trace_directory() / "run")) {
    newest = std::max(newest, entry.path());
  }
  for (const RecordedEvent& event : read_trace(newest).events) {
    if (event.name.starts_with("ros2_deadline:")) {
      late.push_back(event);
    }
  }
  ASSERT_THAT(late, SizeIs(2)) << "neither the quick callback, nor the take of nothing, nor what the middleware keeps";
  EXPECT_EQ(late[0].name, "ros2_deadline:callback");
  EXPECT_EQ(late[0].number("callback"), 2u);
  EXPECT_GE(late[0].number("duration"), 30'000'000u);
  EXPECT_EQ(late[0].number("deadline"), 20'000'000u);
  EXPECT_EQ(late[1].name, "ros2_deadline:message");
  EXPECT_EQ(late[1].number("rmw_subscription_handle"), 4u);
  EXPECT_GE(late[1].number("age"), std::uint64_t{3600} * 1'000'000'000);
}

}  // namespace
