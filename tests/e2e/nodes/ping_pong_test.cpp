// SPDX-License-Identifier: Apache-2.0
// The whole way through the product: launch file, session, two nodes over DDS, and a trace with the events of ROS 2.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/main_thread.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace launch_trace_testing;
using namespace test_support;
using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::Eq;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Ne;
using testing::Pointee;

constexpr std::size_t kExchanges = 10;

// The events of a process's main thread. The context's own writer publishes about the graph whenever an entity comes or
// goes. These publications are left out, because they may come between the layers of another event.
Events thread_of(const Trace& trace, const std::string& process) {
  const Event& graph_writer = *of_main_thread(process, "rmw_publisher_init").first(trace);
  const EventQuery about_graph =
      of_main_thread(process, "rmw_publish").with("rmw_publisher_handle", graph_writer.at("rmw_publisher_handle"));
  Events events = of_main_thread(process, "*").select(trace);
  for (const Event* const publication : about_graph.select(trace)) {
    std::erase(events, publication);
  }
  return events;
}

const Event& publisher_of(const Trace& trace, std::string_view process, std::string_view topic) {
  return *only(trace,
               of_main_thread(std::string(process), "rcl_publisher_init").with("topic_name", std::string(topic)));
}

struct Subscription {
  const Event* init;  // rcl_subscription_init
  std::uint64_t callback;
};

void check_context_and_node(const Trace& trace, const std::string& process) {
  const Events all = of_main_thread(process, "*").select(trace);
  ASSERT_GE(all.size(), 4U);
  const Events first(all.begin(), all.begin() + 4);
  // The graph is published by a thread of rmw.
  EXPECT_THAT(names(first), ElementsAre("rcl_init", "rmw_publisher_init", "rmw_subscription_init", "rcl_node_init"));
  EXPECT_THAT(*first[0], AllOf(HandleField("context_handle", Ne(0U)), TextField("version", Eq("8.10.1"))));
  EXPECT_THAT(*first[3], AllOf(TextField("node_name", Eq(process)), TextField("namespace", Eq("/")),
                               HandleField("node_handle", Ne(0U)), HandleField("rmw_handle", Ne(0U))));
}

void check_publisher(const Trace& trace, const std::string& process, const std::string& topic, std::int64_t depth) {
  const Event& rcl = publisher_of(trace, process, topic);
  EXPECT_EQ(rcl.handle("node_handle"), of_main_thread(process, "rcl_node_init").first(trace)->handle("node_handle"));
  EXPECT_EQ(rcl.number("queue_depth"), depth);
  const Event& rmw = *around(thread_of(trace, process), rcl, 1, 0).front();
  EXPECT_THAT(rmw, AllOf(Named("ros2:rmw_publisher_init"),
                         HandleField("rmw_publisher_handle", Eq(rcl.handle("rmw_publisher_handle")))));
  EXPECT_EQ(rmw.at("gid").array()->size(), 16U);
}

Subscription check_subscription(const Trace& trace, const std::string& process, const std::string& topic) {
  const Event& init = *only(trace, of_main_thread(process, "rcl_subscription_init").with("topic_name", topic));
  EXPECT_EQ(init.handle("node_handle"), of_main_thread(process, "rcl_node_init").first(trace)->handle("node_handle"));
  EXPECT_EQ(init.number("queue_depth"), 10);
  const Events events = around(thread_of(trace, process), init, 1, 3);
  EXPECT_THAT(names(events), ElementsAre("rmw_subscription_init", "rcl_subscription_init", "rclcpp_subscription_init",
                                         "rclcpp_subscription_callback_added", "rclcpp_callback_register"));
  EXPECT_EQ(events[0]->handle("rmw_subscription_handle"), init.handle("rmw_subscription_handle"));
  EXPECT_EQ(events[0]->at("gid").array()->size(), 16U);
  EXPECT_EQ(events[2]->handle("subscription_handle"), init.handle("subscription_handle"));
  EXPECT_EQ(events[3]->handle("subscription"), events[2]->handle("subscription"));
  EXPECT_EQ(events[4]->handle("callback"), events[3]->handle("callback"));
  EXPECT_NE(events[4]->text("symbol"), "");
  return {&init, events[3]->handle("callback")};
}

// The source timestamps of the messages that were published on a topic. Checks the three layers of each.
std::vector<std::int64_t> published(const Trace& trace, const std::string& process, const std::string& topic) {
  const Event& publisher = publisher_of(trace, process, topic);
  const Events thread = thread_of(trace, process);
  std::vector<std::int64_t> timestamps;
  for (const Event* const rcl : of_main_thread(process, "rcl_publish")
                                    .with("publisher_handle", publisher.at("publisher_handle"))
                                    .select(trace)) {
    const Events layers = around(thread, *rcl, 1, 1);
    EXPECT_THAT(names(layers), ElementsAre("rclcpp_publish", "rcl_publish", "rmw_publish"));
    EXPECT_THAT(layers, Each(Pointee(HandleField("message", Eq(rcl->handle("message"))))));
    EXPECT_EQ(layers.back()->handle("rmw_publisher_handle"), publisher.handle("rmw_publisher_handle"));
    timestamps.push_back(layers.back()->number("timestamp"));
  }
  return timestamps;
}

// The source timestamps of the messages that a subscription took. Checks each reception from executor to callback.
std::vector<std::int64_t> received(const Trace& trace, const std::string& process, const Subscription& subscription) {
  const Events thread = thread_of(trace, process);
  std::vector<std::int64_t> timestamps;
  for (const Event* const execution : of_main_thread(process, "rclcpp_executor_execute")
                                          .with("handle", subscription.init->at("subscription_handle"))
                                          .select(trace)) {
    const Events reception = around(thread, *execution, 1, 4);
    EXPECT_THAT(names(reception), ElementsAre("rclcpp_executor_get_next_ready", "rclcpp_executor_execute", "rmw_take",
                                              "rcl_take", "rclcpp_take", "callback_start"));
    const Event& take = *reception[2];
    EXPECT_EQ(take.handle("rmw_subscription_handle"), subscription.init->handle("rmw_subscription_handle"));
    EXPECT_EQ(take.number("taken"), 1);
    EXPECT_EQ(reception[3]->handle("message"), take.handle("message"));
    EXPECT_EQ(reception[4]->handle("message"), take.handle("message"));
    EXPECT_THAT(*reception[5],
                AllOf(HandleField("callback", Eq(subscription.callback)), Field("is_intra_process", Eq(0))));
    EXPECT_THAT(
        trace,
        HasEvent(of_main_thread(process, "callback_end").after(*execution).with("callback", subscription.callback)));
    timestamps.push_back(take.number("source_timestamp"));
  }
  return timestamps;
}

void check_timer(const Trace& trace, std::int64_t period) {
  const Event& init = *of_main_thread("ping", "rcl_timer_init").first(trace);
  const Events thread = thread_of(trace, "ping");
  const Events creation = around(thread, init, 0, 3);
  EXPECT_THAT(names(creation), ElementsAre("rcl_timer_init", "rclcpp_timer_callback_added", "rclcpp_callback_register",
                                           "rclcpp_timer_link_node"));
  EXPECT_EQ(init.number("period"), period);
  EXPECT_EQ(creation[1]->handle("timer_handle"), init.handle("timer_handle"));
  EXPECT_EQ(creation[2]->handle("callback"), creation[1]->handle("callback"));
  EXPECT_EQ(creation[3]->handle("timer_handle"), init.handle("timer_handle"));
  EXPECT_EQ(creation[3]->handle("node_handle"),
            of_main_thread("ping", "rcl_node_init").first(trace)->handle("node_handle"));

  // Looks around an expiry that publishes: the first publication on /ping. The node may also have published a log line.
  const EventQuery publication = of_main_thread("ping", "rcl_publish");
  const Event& publish = *EventQuery(publication)
                              .with("publisher_handle", publisher_of(trace, "ping", "/ping").at("publisher_handle"))
                              .first(trace);
  const Event& begin = *of_main_thread("ping", "rclcpp_executor_get_next_ready").before(publish).select(trace).back();
  const Event& end = *of_main_thread("ping", "callback_end").after(publish).first(trace);
  const Event& log = publisher_of(trace, "ping", "/rosout");
  Events expiry(std::find(thread.begin(), thread.end(), &begin), std::find(thread.begin(), thread.end(), &end) + 1);
  std::erase_if(expiry, [&](const Event* event) {
    return (event->name() == "ros2:rcl_publish" &&
            event->handle("publisher_handle") == log.handle("publisher_handle")) ||
           (event->name() == "ros2:rmw_publish" &&
            event->handle("rmw_publisher_handle") == log.handle("rmw_publisher_handle"));
  });
  EXPECT_THAT(names(expiry), ElementsAre("rclcpp_executor_get_next_ready", "rclcpp_executor_execute", "callback_start",
                                         "rclcpp_publish", "rcl_publish", "rmw_publish", "callback_end"));
  EXPECT_EQ(expiry[1]->handle("handle"), init.handle("timer_handle"));
  EXPECT_THAT(*expiry[2],
              AllOf(HandleField("callback", Eq(creation[1]->handle("callback"))), Field("is_intra_process", Eq(0))));
}

fs::path only_trace(const Sandbox& sandbox) {
  std::vector<fs::path> traces;
  for (const fs::directory_entry& entry : fs::directory_iterator(sandbox.trace_directory())) {
    traces.push_back(entry.path());
  }
  EXPECT_EQ(traces.size(), 1U);
  return traces.empty() ? fs::path() : traces.front();
}

class PingPong : public testing::TestWithParam<const char*> {
 protected:
  std::string file() const { return std::string(EXAMPLES_DIRECTORY "/01_ping_pong.launch.") + GetParam(); }
  Sandbox sandbox_;
};

INSTANTIATE_TEST_SUITE_P(Formats, PingPong, testing::Values("xml", "yaml"),
                         [](const auto& row) { return std::string(row.param); });

TEST_P(PingPong, TraceHoldsTheSequenceOfRos2FieldByField) {
  const CommandResult result = run_command({LAUNCH_PROGRAM, file(), "period_ms:=20"});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(result.output_closed);
  const fs::path directory = only_trace(sandbox_);
  EXPECT_THAT(result.out, HasSubstr("[INFO] [launch.trace]: trace written to: " + directory.string() + " ("));
  EXPECT_THAT(result.out, HasSubstr(" events, 2 processes, "));
  EXPECT_THAT(result.out, HasSubstr("[ping-2] "));
  EXPECT_THAT(result.out, HasSubstr("[pong-1] "));

  const Trace trace(directory);
  EXPECT_THAT(trace, LostNothing());
  std::set<std::int64_t> processes;
  for (const Event& event : trace) {
    if (!event.name().starts_with("launch:")) {  // not the events of the launcher itself
      processes.insert(event.vpid());
    }
  }
  EXPECT_EQ(processes.size(), 2U);

  for (const char* const process : {"ping", "pong"}) {
    SCOPED_TRACE(process);
    check_context_and_node(trace, process);
    check_publisher(trace, process, "/rosout", 1000);
    check_publisher(trace, process, "/parameter_events", 1000);
  }
  check_publisher(trace, "ping", "/ping", 10);
  check_publisher(trace, "pong", "/pong", 10);
  check_timer(trace, 20'000'000);

  const std::vector<std::int64_t> pings = published(trace, "ping", "/ping");
  const std::vector<std::int64_t> pongs = published(trace, "pong", "/pong");
  // The writer got the same timestamp that the reader reports, to the nanosecond. Not every message is taken: one may
  // be sent before the reader knows its writer, and ping may have ended before the last answer.
  const std::vector<std::int64_t> at_pong = received(trace, "pong", check_subscription(trace, "pong", "/ping"));
  const std::vector<std::int64_t> at_ping = received(trace, "ping", check_subscription(trace, "ping", "/pong"));
  for (const auto& [takes, publications] : {std::pair(at_pong, pings), std::pair(at_ping, pongs)}) {
    EXPECT_GE(takes.size(), kExchanges);
    EXPECT_TRUE(std::is_sorted(takes.begin(), takes.end()));
    EXPECT_TRUE(std::includes(publications.begin(), publications.end(), takes.begin(), takes.end()));
  }
}

TEST_P(PingPong, Babeltrace2ReadsTheTraceWithoutAWarning) {
  const CommandResult result = run_command({LAUNCH_PROGRAM, file(), "count:=2", "period_ms:=20"});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const CommandResult read = run_command({"babeltrace2", only_trace(sandbox_).string()});
  EXPECT_EQ(read.exit_code, 0);
  EXPECT_EQ(read.err, "");
  for (const char* const part : {"ros2:rcl_init", "ros2:callback_end", "procname = \"ping\"", "procname = \"pong\""}) {
    EXPECT_THAT(read.out, HasSubstr(part));
  }
}

TEST_P(PingPong, CtrlCEndsTheNodesAndLeavesAWholeTraceAndNoSession) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file(), "count:=0", "period_ms:=20"}});
  ASSERT_TRUE(run.wait_for_output("[pong-1] ")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("user interrupted with ctrl-c (SIGINT)"));
  EXPECT_THAT(result.out, HasSubstr("[ping-2]: process has finished cleanly"));
  EXPECT_THAT(result.out, HasSubstr("[pong-1]: process has finished cleanly"));

  const Trace trace(only_trace(sandbox_));
  EXPECT_THAT(trace, LostNothing());
  EXPECT_FALSE(published(trace, "pong", "/pong").empty());
  const CommandResult sessions = run_command({"lttng", "list"});
  EXPECT_THAT(sessions.out + sessions.err, HasSubstr("Currently no available recording session"));
}

// The pid of a child with this name, or -1.
pid_t child_named(pid_t parent, const std::string& name) {
  const std::string folder = "/proc/" + std::to_string(parent);
  std::istringstream children(read_file(folder + "/task/" + std::to_string(parent) + "/children"));
  for (pid_t child; children >> child;) {
    if (read_file("/proc/" + std::to_string(child) + "/comm") == name + "\n") {
      return child;
    }
  }
  ADD_FAILURE() << "process " << parent << " has no child " << name;
  return -1;
}

TEST_P(PingPong, KillOfTheLauncherLeavesNoProcessNoSessionAndAWholeTrace) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, file(), "count:=0", "period_ms:=20"}});
  ASSERT_TRUE(run.wait_for_output("[pong-1] ")) << run.out() << run.err();
  // The started process is the guardian, above its spare.
  const pid_t spare = child_named(run.pid(), "guardian-spare");
  ASSERT_GT(spare, 0);
  const pid_t launcher = child_named(spare, "launch");
  ASSERT_GT(launcher, 0);
  for (const char* const name : {"ping", "pong"}) {
    child_named(launcher, name);
  }
  ::kill(launcher, SIGKILL);
  EXPECT_EQ(run.wait().signal, SIGKILL);
  const CommandResult sessions = run_command({"lttng", "list"});
  EXPECT_THAT(sessions.out + sessions.err, HasSubstr("Currently no available recording session"));
  EXPECT_THAT(sandbox_.end_processes(), IsEmpty());

  const CommandResult read = run_command({"babeltrace2", only_trace(sandbox_).string()});
  EXPECT_EQ(read.exit_code, 0);
  EXPECT_EQ(read.err, "");
  EXPECT_THAT(read.out, HasSubstr("ros2:callback_end"));
  // On a busy machine the launcher may be killed before the session daemon knows it. Nothing else may be missing.
  EXPECT_THAT(
      read_file(only_trace(sandbox_) / "verdict.json"),
      AnyOf(
          HasSubstr("\"complete\": true"),
          HasSubstr("\"cut_short\": false,\n  \"damage\": \"\",\n  \"absent\": [\n    \"the launcher's own events are "
                    "missing: the session daemon had not registered the launcher when the launch ended\"\n  ],\n"
                    "  \"discarded_events\": 0,\n  \"lost_packets\": 0,")));
}

TEST(PingPongPlan, DryRunStartsNothingAndShowsBothNodes) {
  Sandbox sandbox;
  const CommandResult xml =
      run_command({LAUNCH_PROGRAM, "--dry-run=json", EXAMPLES_DIRECTORY "/01_ping_pong.launch.xml"});
  const CommandResult yaml = run_command({LAUNCH_PROGRAM, "--dry-run", EXAMPLES_DIRECTORY "/01_ping_pong.launch.yaml"});
  EXPECT_EQ(xml.exit_code, 0) << xml.err;
  EXPECT_THAT(xml.out, HasSubstr("/lib/demo_nodes/ping\""));
  EXPECT_THAT(xml.out, HasSubstr("\"session-name\": \"ping_pong-2"));
  EXPECT_EQ(yaml.exit_code, 0) << yaml.err;
  EXPECT_THAT(yaml.out, HasSubstr("2 processes, 1 trace; nothing was started\n"));
  EXPECT_FALSE(fs::exists(sandbox.trace_directory()) && !fs::is_empty(sandbox.trace_directory()));
}

}  // namespace
