// SPDX-License-Identifier: Apache-2.0
// The trace of messages that stay in their process.
#include <gmock/gmock.h>

#include <optional>
#include <set>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::ElementsAre;
using Events = std::vector<RecordedEvent>;

constexpr const char* kLaunchFile = R"xml(<launch>
  <trace session-name="intra" events-ust="ros2:* ros2_ext:*" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <executable cmd="$(env WORKER)" name="worker" output="screen"/>
</launch>
)xml";

std::vector<std::string> names(const Events& events) {
  std::vector<std::string> result;
  for (const RecordedEvent& event : events) {
    result.push_back(event.name.substr(event.name.find(':') + 1));
  }
  return result;
}

// The events of the worker's main thread in their order, without those of the executor and without those of the graph
// messages that the context's own writer publishes.
class IntraProcessTrace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Sandbox sandbox;
    const fs::path file = sandbox.directory() / "intra.launch.xml";
    write_file(file, kLaunchFile);
    const CommandResult result = run_command(Command{{LAUNCH_PROGRAM, file.string()}, {{"WORKER", WORKER}}});
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    const RecordedTrace trace = read_trace(sandbox.trace_directory() / "intra");
    EXPECT_EQ(trace.losses, 0U);
    std::optional<std::uint64_t> graph_writer;
    for (const RecordedEvent& event : trace.events) {
      if (event.procname != std::string("intra_process_worker").substr(0, 15) || event.vpid != event.vtid) {
        continue;
      }
      all_events_.push_back(event);
      if (!event.name.starts_with("ros2:") || event.name.find("executor") != std::string::npos) {
        continue;
      }
      if (!graph_writer && event.name == "ros2:rmw_publisher_init") {
        graph_writer = event.number("rmw_publisher_handle");
      }
      if (event.name != "ros2:rmw_publish" || event.number("rmw_publisher_handle") != graph_writer) {
        events_.push_back(event);
      }
    }
  }
  static void TearDownTestSuite() {
    events_.clear();
    all_events_.clear();
  }

  // The events from the nth event of that name on.
  static Events from(const std::string& name, std::size_t n, std::size_t count) {
    for (std::size_t i = 0; i + count <= events_.size(); ++i) {
      if (events_[i].name == "ros2:" + name && n-- == 0) {
        const auto begin = events_.begin() + static_cast<std::ptrdiff_t>(i);
        return {begin, begin + static_cast<std::ptrdiff_t>(count)};
      }
    }
    ADD_FAILURE() << "no such event " << name;
    return Events(count);
  }

  // The creation of the first subscription with intra-process communication.
  static Events creation() { return from("rclcpp_construct_ring_buffer", 0, 9); }

  static std::uint64_t publisher_of(const std::string& topic) {
    for (const RecordedEvent& event : events_) {
      if (event.name == "ros2:rcl_publisher_init" && event.text("topic_name") == topic) {
        return event.number("publisher_handle");
      }
    }
    ADD_FAILURE() << "no publisher on " << topic;
    return 0;
  }

  static Events events_;
  static Events all_events_;  // also those of the executor and of provider ros2_ext
};

Events IntraProcessTrace::events_;
Events IntraProcessTrace::all_events_;

TEST_F(IntraProcessTrace, ASubscriptionIsCreatedTwiceOnceForEachWay) {
  const Events events = creation();
  EXPECT_THAT(
      names(events),
      ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb", "rclcpp_ipb_to_subscription",
                  "rclcpp_subscription_callback_added", "rclcpp_callback_register", "rclcpp_subscription_init",
                  "rclcpp_subscription_init", "rclcpp_subscription_callback_added", "rclcpp_callback_register"));
  EXPECT_EQ(events[0].number("capacity"), 2U);
  EXPECT_EQ(events[1].number("buffer"), events[0].number("buffer"));
  EXPECT_EQ(events[2].number("ipb"), events[1].number("ipb"));

  const std::uint64_t near = events[2].number("subscription");
  EXPECT_EQ(events[3].number("subscription"), near);
  EXPECT_EQ(events[4].number("callback"), events[3].number("callback"));
  EXPECT_EQ(events[5].number("subscription"), near);

  EXPECT_EQ(events[6].number("subscription_handle"), events[5].number("subscription_handle"));
  EXPECT_NE(events[6].number("subscription"), near);
  EXPECT_EQ(events[7].number("subscription"), events[6].number("subscription"));
  EXPECT_NE(events[7].number("callback"), events[3].number("callback"));
  EXPECT_EQ(events[8].number("callback"), events[7].number("callback"));
  EXPECT_EQ(events[8].text("symbol"), events[4].text("symbol"));
  EXPECT_THAT(events[8].text("symbol"), testing::HasSubstr("main"));
}

TEST_F(IntraProcessTrace, AMessageForNobodyIsPublishedAllTheSame) {
  const Events events = from("rclcpp_intra_publish", 0, 2);
  EXPECT_EQ(events[0].number("publisher_handle"), publisher_of("/topic"));
  EXPECT_NE(events[0].number("message"), 0U);
  EXPECT_EQ(events[1].name, "ros2:rmw_subscription_init");  // the next step of the worker
}

TEST_F(IntraProcessTrace, MessagesGoThroughTheRingBuffer) {
  const Events events = from("rclcpp_intra_publish", 1, 12);
  EXPECT_THAT(names(events),
              ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_intra_publish",
                          "rclcpp_ring_buffer_enqueue", "rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue",
                          "rclcpp_ring_buffer_dequeue", "callback_start", "callback_end", "rclcpp_ring_buffer_dequeue",
                          "callback_start", "callback_end"));
  const std::uint64_t buffer = creation()[0].number("buffer");
  const auto expect_enqueue = [buffer](const RecordedEvent& event, std::uint64_t index, std::uint64_t size,
                                       std::uint64_t overwritten) {
    EXPECT_EQ(event.number("buffer"), buffer);
    EXPECT_EQ(event.number("index"), index);
    EXPECT_EQ(event.number("size"), size);
    EXPECT_EQ(event.number("overwritten"), overwritten);
  };
  expect_enqueue(events[1], 0, 1, 0);
  expect_enqueue(events[3], 1, 2, 0);
  expect_enqueue(events[5], 0, 3, 1);  // one more than it can hold, as in ROS 2
  const auto expect_callback = [&](std::size_t i, std::uint64_t index, std::uint64_t size) {
    EXPECT_EQ(events[i].number("buffer"), buffer);
    EXPECT_EQ(events[i].number("index"), index);
    EXPECT_EQ(events[i].number("size"), size);
    EXPECT_EQ(events[i + 1].number("callback"), creation()[3].number("callback"));
    EXPECT_EQ(events[i + 1].number("is_intra_process"), 1U);
    EXPECT_EQ(events[i + 2].number("callback"), creation()[3].number("callback"));
  };
  expect_callback(6, 1, 1);
  expect_callback(9, 0, 0);
}

TEST_F(IntraProcessTrace, TheMiddlewareComesAfterTheBuffers) {
  const Events events = from("rclcpp_intra_publish", 4, 5);
  EXPECT_THAT(names(events), ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_publish",
                                         "rcl_publish", "rmw_publish"));
  EXPECT_EQ(events[3].number("message"), events[2].number("message"));
  EXPECT_EQ(events[4].number("message"), events[2].number("message"));
  EXPECT_EQ(events[3].number("publisher_handle"), publisher_of("/topic"));

  // The subscription with intra-process communication gets the message twice and calls back once.
  std::size_t taken = 0;
  std::vector<std::uint64_t> is_intra_process;
  bool after = false;
  for (const RecordedEvent& event : events_) {
    after |= event.timestamp == events[0].timestamp;
    if (after && event.name == "ros2:rmw_take") {
      taken += event.number("taken");
    } else if (after && event.name == "ros2:callback_start") {
      is_intra_process.push_back(event.number("is_intra_process"));
    }
  }
  EXPECT_LE(taken, 2U);  // the second may not have been taken when the worker ended
  EXPECT_THAT(is_intra_process, testing::UnorderedElementsAre(0U, 1U));
}

TEST_F(IntraProcessTrace, ATransientLocalPublisherHasABufferWithoutSubscription) {
  const Events creation = from("rclcpp_construct_ring_buffer", 1, 2);
  EXPECT_THAT(names(creation), ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb"));
  EXPECT_EQ(creation[0].number("capacity"), 1U);
  EXPECT_EQ(creation[1].number("buffer"), creation[0].number("buffer"));
  const Events publication = from("rclcpp_intra_publish", 5, 5);
  EXPECT_THAT(names(publication), ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_publish",
                                              "rcl_publish", "rmw_publish"));
  EXPECT_EQ(publication[0].number("publisher_handle"), publisher_of("/latched"));
  EXPECT_EQ(publication[1].number("buffer"), creation[0].number("buffer"));
}

TEST_F(IntraProcessTrace, TheExtensionTellsTheEndOfEveryObjectAndTheWaitableThatIsExecuted) {
  const auto expect_ends = [](const std::string& begin, const std::string& end, const std::string& field,
                              std::size_t number) {
    std::set<std::uint64_t> living;
    std::size_t begun = 0;
    for (const RecordedEvent& event : all_events_) {
      if (event.name == "ros2:" + begin) {
        EXPECT_TRUE(living.insert(event.number(field)).second) << begin << " of something that has not ended";
        ++begun;
      } else if (event.name == "ros2_ext:" + end) {
        EXPECT_EQ(living.erase(event.number(field)), 1U) << end << " of something that has not begun";
      }
    }
    EXPECT_EQ(begun, number) << begin;
    EXPECT_THAT(living, testing::IsEmpty()) << end;
  };
  expect_ends("rclcpp_construct_ring_buffer", "rclcpp_ring_buffer_fini", "buffer", 3);
  expect_ends("rclcpp_buffer_to_ipb", "rclcpp_ipb_fini", "ipb", 3);
  expect_ends("rclcpp_subscription_init", "rclcpp_subscription_fini", "subscription", 3);

  std::size_t executed = 0;
  for (const RecordedEvent& event : all_events_) {
    if (event.name == "ros2_ext:rclcpp_executor_execute_waitable") {
      EXPECT_EQ(event.number("waitable"), creation()[2].number("subscription"));
      ++executed;
    }
  }
  EXPECT_EQ(executed, 3U);
}

TEST_F(IntraProcessTrace, ABufferCanBeCleared) {
  const Events events = from("rclcpp_construct_ring_buffer", 2, 3);
  EXPECT_THAT(names(events),
              ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb", "rclcpp_ring_buffer_clear"));
  EXPECT_EQ(events[0].number("capacity"), 7U);
  EXPECT_EQ(events[2].number("buffer"), events[0].number("buffer"));
}

}  // namespace
