// SPDX-License-Identifier: Apache-2.0
// The whole way through the product: launch file, session, two nodes over DDS, and a trace with the events of ROS 2.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kExchanges = 10;
using Events = std::vector<RecordedEvent>;

std::vector<std::string> names(const Events& events) {
  std::vector<std::string> result;
  for (const RecordedEvent& event : events) {
    result.push_back(event.name.substr(event.name.find(':') + 1));
  }
  return result;
}

// The events of one process's main thread. The context's own writer publishes about the graph whenever an entity comes
// or goes. These events are kept apart, because they may come between the layers of another event.
class Process {
 public:
  Process(const RecordedTrace& trace, const std::string& procname) {
    for (const RecordedEvent& event : trace.events) {
      if (event.procname == procname && event.vpid == event.vtid) {
        all_events_.push_back(event);
      }
    }
    std::uint64_t graph_writer = 0;
    for (const RecordedEvent& event : all_events_) {
      if (graph_writer == 0 && event.name == "ros2:rmw_publisher_init") {
        graph_writer = event.number("rmw_publisher_handle");
      }
      if (event.name != "ros2:rmw_publish" || event.number("rmw_publisher_handle") != graph_writer) {
        events_.push_back(event);
      }
    }
  }

  const Events& events() const { return events_; }
  const Events& all_events() const { return all_events_; }

  // Index of the first event of that name from `from` on. When a field is named, `field` must be equal to `value`.
  std::size_t find(const std::string& name, std::size_t from = 0, const std::string& field = {},
                   std::uint64_t value = 0) const {
    for (std::size_t i = from; i < events_.size(); ++i) {
      if (events_[i].name == "ros2:" + name && (field.empty() || events_[i].number(field) == value)) {
        return i;
      }
    }
    ADD_FAILURE() << "no event " << name << " " << field << " from " << from << " on";
    return events_.size();
  }
  std::size_t find_topic(const std::string& name, const std::string& topic) const {
    for (std::size_t i = 0; i < events_.size(); ++i) {
      if (events_[i].name == "ros2:" + name && events_[i].text("topic_name") == topic) {
        return i;
      }
    }
    ADD_FAILURE() << "no event " << name << " of topic " << topic;
    return events_.size();
  }
  Events range(std::size_t begin, std::size_t end) const {
    return {events_.begin() + static_cast<std::ptrdiff_t>(begin),
            events_.begin() + static_cast<std::ptrdiff_t>(std::min(end, events_.size()))};
  }
  // The same events, without those of the messages that the node publishes on a topic by itself, like /rosout.
  Events without_topic(Events events, const std::string& topic) const {
    const RecordedEvent& publisher = events_.at(find_topic("rcl_publisher_init", topic));
    const std::uint64_t handle = publisher.number("publisher_handle");
    const std::uint64_t rmw_handle = publisher.number("rmw_publisher_handle");
    std::erase_if(events, [&](const RecordedEvent& event) {
      return (event.name == "ros2:rcl_publish" && event.number("publisher_handle") == handle) ||
             (event.name == "ros2:rmw_publish" && event.number("rmw_publisher_handle") == rmw_handle);
    });
    return events;
  }

 private:
  Events all_events_;
  Events events_;
};

struct Subscription {
  std::uint64_t handle;
  std::uint64_t rmw_handle;
  std::uint64_t callback;
};

void check_context_and_node(const Process& process, const std::string& node_name) {
  const Events& all = process.all_events();
  // The graph is published by a thread of rmw.
  EXPECT_THAT(names({all.begin(), all.begin() + 4}),
              ElementsAre("rcl_init", "rmw_publisher_init", "rmw_subscription_init", "rcl_node_init"));
  const std::size_t node = process.find("rcl_node_init");
  EXPECT_NE(process.events().at(0).number("context_handle"), 0U);
  EXPECT_EQ(process.events().at(0).text("version"), "8.10.1");
  const RecordedEvent& event = process.events().at(node);
  EXPECT_EQ(event.text("node_name"), node_name);
  EXPECT_EQ(event.text("namespace"), "/");
  EXPECT_NE(event.number("node_handle"), 0U);
  EXPECT_NE(event.number("rmw_handle"), 0U);
}

void check_publisher(const Process& process, const std::string& topic, std::uint64_t depth) {
  const std::size_t at = process.find_topic("rcl_publisher_init", topic);
  const RecordedEvent& rcl = process.events().at(at);
  const RecordedEvent& rmw = process.events().at(at - 1);
  EXPECT_EQ(rmw.name, "ros2:rmw_publisher_init");
  EXPECT_EQ(rmw.number("rmw_publisher_handle"), rcl.number("rmw_publisher_handle"));
  EXPECT_EQ(rmw.arrays.at("gid").size(), 16U);
  EXPECT_EQ(rcl.number("node_handle"), process.events().at(process.find("rcl_node_init")).number("node_handle"));
  EXPECT_EQ(rcl.number("queue_depth"), depth);
}

Subscription check_subscription(const Process& process, const std::string& topic) {
  const std::size_t at = process.find_topic("rcl_subscription_init", topic);
  const Events events = process.range(at - 1, at + 4);
  EXPECT_THAT(names(events), ElementsAre("rmw_subscription_init", "rcl_subscription_init", "rclcpp_subscription_init",
                                         "rclcpp_subscription_callback_added", "rclcpp_callback_register"));
  EXPECT_EQ(events[0].number("rmw_subscription_handle"), events[1].number("rmw_subscription_handle"));
  EXPECT_EQ(events[0].arrays.at("gid").size(), 16U);
  EXPECT_EQ(events[1].number("node_handle"), process.events().at(process.find("rcl_node_init")).number("node_handle"));
  EXPECT_EQ(events[1].number("queue_depth"), 10U);
  EXPECT_EQ(events[2].number("subscription_handle"), events[1].number("subscription_handle"));
  EXPECT_EQ(events[3].number("subscription"), events[2].number("subscription"));
  EXPECT_EQ(events[4].number("callback"), events[3].number("callback"));
  EXPECT_NE(events[4].text("symbol"), "");
  return {events[1].number("subscription_handle"), events[1].number("rmw_subscription_handle"),
          events[3].number("callback")};
}

// The source timestamps of the messages that were published on a topic. Checks the three layers of each.
std::vector<std::uint64_t> published(const Process& process, const std::string& topic) {
  const RecordedEvent& publisher = process.events().at(process.find_topic("rcl_publisher_init", topic));
  std::vector<std::uint64_t> timestamps;
  const Events& events = process.events();
  for (std::size_t i = 1; i + 1 < events.size(); ++i) {
    if (events[i].name != "ros2:rcl_publish" ||
        events[i].number("publisher_handle") != publisher.number("publisher_handle")) {
      continue;
    }
    EXPECT_EQ(events[i - 1].name, "ros2:rclcpp_publish");
    EXPECT_EQ(events[i + 1].name, "ros2:rmw_publish");
    EXPECT_EQ(events[i - 1].number("message"), events[i].number("message"));
    EXPECT_EQ(events[i + 1].number("message"), events[i].number("message"));
    EXPECT_EQ(events[i + 1].number("rmw_publisher_handle"), publisher.number("rmw_publisher_handle"));
    timestamps.push_back(events[i + 1].number("timestamp"));
  }
  return timestamps;
}

// The source timestamps of the messages that a subscription took. Checks each reception from executor to callback.
std::vector<std::uint64_t> received(const Process& process, const Subscription& subscription) {
  std::vector<std::uint64_t> timestamps;
  const Events& events = process.events();
  for (std::size_t i = 1; i < events.size(); ++i) {
    if (events[i].name != "ros2:rclcpp_executor_execute" || events[i].number("handle") != subscription.handle) {
      continue;
    }
    const Events reception = process.range(i - 1, i + 5);
    EXPECT_THAT(names(reception), ElementsAre("rclcpp_executor_get_next_ready", "rclcpp_executor_execute", "rmw_take",
                                              "rcl_take", "rclcpp_take", "callback_start"));
    const RecordedEvent& take = reception[2];
    EXPECT_EQ(take.number("rmw_subscription_handle"), subscription.rmw_handle);
    EXPECT_EQ(take.number("taken"), 1U);
    EXPECT_EQ(reception[3].number("message"), take.number("message"));
    EXPECT_EQ(reception[4].number("message"), take.number("message"));
    EXPECT_EQ(reception[5].number("callback"), subscription.callback);
    EXPECT_EQ(reception[5].number("is_intra_process"), 0U);
    process.find("callback_end", i, "callback", subscription.callback);
    timestamps.push_back(take.number("source_timestamp"));
  }
  return timestamps;
}

void check_timer(const Process& process, std::uint64_t period) {
  const std::size_t at = process.find("rcl_timer_init");
  const Events events = process.range(at, at + 4);
  EXPECT_THAT(names(events), ElementsAre("rcl_timer_init", "rclcpp_timer_callback_added", "rclcpp_callback_register",
                                         "rclcpp_timer_link_node"));
  EXPECT_EQ(events[0].number("period"), period);
  EXPECT_EQ(events[1].number("timer_handle"), events[0].number("timer_handle"));
  EXPECT_EQ(events[2].number("callback"), events[1].number("callback"));
  EXPECT_EQ(events[3].number("timer_handle"), events[0].number("timer_handle"));
  EXPECT_EQ(events[3].number("node_handle"), process.events().at(process.find("rcl_node_init")).number("node_handle"));

  // Looks around an expiry that publishes: the first publication on /ping.
  const std::uint64_t publisher =
      process.events().at(process.find_topic("rcl_publisher_init", "/ping")).number("publisher_handle");
  const std::size_t publish = process.find("rcl_publish", 0, "publisher_handle", publisher);
  std::size_t begin = publish;
  while (begin > 0 && process.events()[begin].name != "ros2:rclcpp_executor_get_next_ready") {
    --begin;
  }
  const std::size_t end = process.find("callback_end", publish);
  const Events expiry = process.without_topic(process.range(begin, end + 1), "/rosout");
  EXPECT_THAT(names(expiry), ElementsAre("rclcpp_executor_get_next_ready", "rclcpp_executor_execute", "callback_start",
                                         "rclcpp_publish", "rcl_publish", "rmw_publish", "callback_end"));
  EXPECT_EQ(expiry[1].number("handle"), events[0].number("timer_handle"));
  EXPECT_EQ(expiry[2].number("callback"), events[1].number("callback"));
  EXPECT_EQ(expiry[2].number("is_intra_process"), 0U);
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

  const RecordedTrace trace = read_trace(directory);
  EXPECT_EQ(trace.losses, 0U);
  std::set<std::int64_t> processes;
  for (const RecordedEvent& event : trace.events) {
    if (!event.name.starts_with("launch:")) {  // not the events of the launcher itself
      processes.insert(event.vpid);
    }
  }
  EXPECT_EQ(processes.size(), 2U);

  const Process ping(trace, "ping");
  const Process pong(trace, "pong");
  ASSERT_FALSE(ping.events().empty());
  ASSERT_FALSE(pong.events().empty());
  for (const Process* process : {&ping, &pong}) {
    check_publisher(*process, "/rosout", 1000);
    check_publisher(*process, "/parameter_events", 1000);
  }
  check_context_and_node(ping, "ping");
  check_context_and_node(pong, "pong");
  check_publisher(ping, "/ping", 10);
  check_publisher(pong, "/pong", 10);
  check_timer(ping, 20'000'000);

  const std::vector<std::uint64_t> pings = published(ping, "/ping");
  const std::vector<std::uint64_t> pongs = published(pong, "/pong");
  // The writer got the same timestamp that the reader reports, to the nanosecond. Not every message is taken: one may
  // be sent before the reader knows its writer, and ping may have ended before the last answer.
  const std::vector<std::uint64_t> at_pong = received(pong, check_subscription(pong, "/ping"));
  const std::vector<std::uint64_t> at_ping = received(ping, check_subscription(ping, "/pong"));
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

  const RecordedTrace trace = read_trace(only_trace(sandbox_));
  EXPECT_EQ(trace.losses, 0U);
  EXPECT_FALSE(published(Process(trace, "pong"), "/pong").empty());
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
  // The started process is the guardian.
  const pid_t launcher = child_named(run.pid(), "launch");
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
  EXPECT_THAT(read_file(only_trace(sandbox_) / "verdict.json"), HasSubstr("\"complete\": true"));
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
