// SPDX-License-Identifier: Apache-2.0
// The trace of messages that stay in their process.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/main_thread.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace launch_trace_testing;
using namespace test_support;
using testing::AllOf;
using testing::ElementsAre;
using testing::Eq;
using testing::Pointee;
using testing::UnorderedElementsAre;

constexpr const char* kLaunchFile = R"xml(<launch>
  <trace session-name="intra" events-ust="ros2:* ros2_ext:*" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <executable cmd="$(env WORKER)" name="worker" output="screen"/>
</launch>
)xml";

constexpr const char* kWorker = "intra_process_worker";

class IntraProcessTrace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Sandbox sandbox;
    const fs::path file = sandbox.directory() / "intra.launch.xml";
    write_file(file, kLaunchFile);
    const CommandResult result = run_command(Command{{LAUNCH_PROGRAM, file.string()}, {{"WORKER", WORKER}}});
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    trace_ = Trace(sandbox.trace_directory() / "intra");
    EXPECT_THAT(trace_, LostNothing());
    // The context's own writer publishes about the graph at any time.
    const Event& graph_writer = *of_main_thread(kWorker, "rmw_publisher_init").first(trace_);
    const EventQuery about_graph =
        of_main_thread(kWorker, "rmw_publish").with("rmw_publisher_handle", graph_writer.at("rmw_publisher_handle"));
    const Events left_out = about_graph.select(trace_);
    events_ = of_main_thread(kWorker, "*").select(trace_);
    std::erase_if(events_, [&](const Event* event) {
      return event->name().starts_with("ros2:rclcpp_executor") ||
             std::find(left_out.begin(), left_out.end(), event) != left_out.end();
    });
  }
  static void TearDownTestSuite() {
    events_.clear();
    trace_ = Trace();
  }

  // The events from the nth event of that name on.
  static Events from(const std::string& name, std::size_t n, std::ptrdiff_t count) {
    return around(events_, *of_main_thread(kWorker, name).select(trace_).at(n), 0, count - 1);
  }

  // The creation of the first subscription with intra-process communication.
  static Events creation() { return from("rclcpp_construct_ring_buffer", 0, 9); }

  static std::uint64_t publisher_of(const std::string& topic) {
    return only(trace_, of_main_thread(kWorker, "rcl_publisher_init").with("topic_name", topic))
        ->handle("publisher_handle");
  }

  static Trace trace_;
  static Events events_;  // of the worker's main thread, without those of the executor and of the graph
};

Trace IntraProcessTrace::trace_;
Events IntraProcessTrace::events_;

TEST_F(IntraProcessTrace, ASubscriptionIsCreatedTwiceOnceForEachWay) {
  const Events events = creation();
  EXPECT_THAT(
      names(events),
      ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb", "rclcpp_ipb_to_subscription",
                  "rclcpp_subscription_callback_added", "rclcpp_callback_register", "rclcpp_subscription_init",
                  "rclcpp_subscription_init", "rclcpp_subscription_callback_added", "rclcpp_callback_register"));
  EXPECT_EQ(events[0]->number("capacity"), 2);
  EXPECT_EQ(events[1]->handle("buffer"), events[0]->handle("buffer"));
  EXPECT_EQ(events[2]->handle("ipb"), events[1]->handle("ipb"));

  const std::uint64_t near = events[2]->handle("subscription");
  EXPECT_EQ(events[3]->handle("subscription"), near);
  EXPECT_EQ(events[4]->handle("callback"), events[3]->handle("callback"));
  EXPECT_EQ(events[5]->handle("subscription"), near);

  EXPECT_EQ(events[6]->handle("subscription_handle"), events[5]->handle("subscription_handle"));
  EXPECT_NE(events[6]->handle("subscription"), near);
  EXPECT_EQ(events[7]->handle("subscription"), events[6]->handle("subscription"));
  EXPECT_NE(events[7]->handle("callback"), events[3]->handle("callback"));
  EXPECT_EQ(events[8]->handle("callback"), events[7]->handle("callback"));
  EXPECT_EQ(events[8]->text("symbol"), events[4]->text("symbol"));
  EXPECT_THAT(events[8]->text("symbol"), testing::HasSubstr("main"));
}

TEST_F(IntraProcessTrace, AMessageForNobodyIsPublishedAllTheSame) {
  const Events events = from("rclcpp_intra_publish", 0, 2);
  EXPECT_EQ(events[0]->handle("publisher_handle"), publisher_of("/topic"));
  EXPECT_NE(events[0]->handle("message"), 0U);
  EXPECT_EQ(events[1]->name(), "ros2:rmw_subscription_init");  // the next step of the worker
}

TEST_F(IntraProcessTrace, MessagesGoThroughTheRingBuffer) {
  const Events events = from("rclcpp_intra_publish", 1, 12);
  EXPECT_THAT(names(events),
              ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_intra_publish",
                          "rclcpp_ring_buffer_enqueue", "rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue",
                          "rclcpp_ring_buffer_dequeue", "callback_start", "callback_end", "rclcpp_ring_buffer_dequeue",
                          "callback_start", "callback_end"));
  const std::uint64_t buffer = creation()[0]->handle("buffer");
  const auto enqueues = [buffer](std::int64_t index, std::int64_t size, std::int64_t overwritten) {
    return Pointee(AllOf(HandleField("buffer", Eq(buffer)), Field("index", Eq(index)), Field("size", Eq(size)),
                         Field("overwritten", Eq(overwritten))));
  };
  EXPECT_THAT(events[1], enqueues(0, 1, 0));
  EXPECT_THAT(events[3], enqueues(1, 2, 0));
  EXPECT_THAT(events[5], enqueues(0, 3, 1));  // one more than it can hold, as in ROS 2
  const auto expect_callback = [&](std::size_t i, std::int64_t index, std::int64_t size) {
    EXPECT_EQ(events[i]->handle("buffer"), buffer);
    EXPECT_EQ(events[i]->number("index"), index);
    EXPECT_EQ(events[i]->number("size"), size);
    EXPECT_EQ(events[i + 1]->handle("callback"), creation()[3]->handle("callback"));
    EXPECT_EQ(events[i + 1]->number("is_intra_process"), 1);
    EXPECT_EQ(events[i + 2]->handle("callback"), creation()[3]->handle("callback"));
  };
  expect_callback(6, 1, 1);
  expect_callback(9, 0, 0);
}

TEST_F(IntraProcessTrace, TheMiddlewareComesAfterTheBuffers) {
  const Events events = from("rclcpp_intra_publish", 4, 5);
  EXPECT_THAT(names(events), ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_publish",
                                         "rcl_publish", "rmw_publish"));
  EXPECT_EQ(events[3]->handle("message"), events[2]->handle("message"));
  EXPECT_EQ(events[4]->handle("message"), events[2]->handle("message"));
  EXPECT_EQ(events[3]->handle("publisher_handle"), publisher_of("/topic"));

  // The subscription with intra-process communication gets the message twice and calls back once.
  const Events takes = of_main_thread(kWorker, "rmw_take").with("taken", 1).after(*events[0]).select(trace_);
  EXPECT_LE(takes.size(), 2U);  // the second may not have been taken when the worker ended
  const Events callbacks = of_main_thread(kWorker, "callback_start").after(*events[0]).select(trace_);
  EXPECT_THAT(callbacks, UnorderedElementsAre(Pointee(Field("is_intra_process", Eq(0))),
                                              Pointee(Field("is_intra_process", Eq(1)))));
}

TEST_F(IntraProcessTrace, ATransientLocalPublisherHasABufferWithoutSubscription) {
  const Events creation = from("rclcpp_construct_ring_buffer", 1, 2);
  EXPECT_THAT(names(creation), ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb"));
  EXPECT_EQ(creation[0]->number("capacity"), 1);
  EXPECT_EQ(creation[1]->handle("buffer"), creation[0]->handle("buffer"));
  const Events publication = from("rclcpp_intra_publish", 5, 5);
  EXPECT_THAT(names(publication), ElementsAre("rclcpp_intra_publish", "rclcpp_ring_buffer_enqueue", "rclcpp_publish",
                                              "rcl_publish", "rmw_publish"));
  EXPECT_EQ(publication[0]->handle("publisher_handle"), publisher_of("/latched"));
  EXPECT_EQ(publication[1]->handle("buffer"), creation[0]->handle("buffer"));
}

TEST_F(IntraProcessTrace, TheExtensionTellsTheEndOfEveryObjectAndTheWaitableThatIsExecuted) {
  const EventQuery main_thread = event("*").in_process(kWorker).that(
      "in its main thread", [](const Event& event) { return event.vpid() == event.vtid(); });
  const auto expect_ends = [&](const std::string& begin, const std::string& end, const std::string& field,
                               std::size_t number) {
    std::set<std::uint64_t> living;
    std::size_t begun = 0;
    for (const Event* const event : main_thread.select(trace_)) {
      if (event->name() == "ros2:" + begin) {
        EXPECT_TRUE(living.insert(event->handle(field)).second) << begin << " of something that has not ended";
        ++begun;
      } else if (event->name() == "ros2_ext:" + end) {
        EXPECT_EQ(living.erase(event->handle(field)), 1U) << end << " of something that has not begun";
      }
    }
    EXPECT_EQ(begun, number) << begin;
    EXPECT_THAT(living, testing::IsEmpty()) << end;
  };
  expect_ends("rclcpp_construct_ring_buffer", "rclcpp_ring_buffer_fini", "buffer", 3);
  expect_ends("rclcpp_buffer_to_ipb", "rclcpp_ipb_fini", "ipb", 3);
  expect_ends("rclcpp_subscription_init", "rclcpp_subscription_fini", "subscription", 3);

  const EventQuery executions = event("ros2_ext:rclcpp_executor_execute_waitable").in_process(kWorker);
  EXPECT_THAT(trace_, HasEvents(executions, exactly(3)));
  EXPECT_THAT(trace_, EachEvent(executions, event("").with("waitable", creation()[2]->at("subscription"))));
}

TEST_F(IntraProcessTrace, ABufferCanBeCleared) {
  const Events events = from("rclcpp_construct_ring_buffer", 2, 3);
  EXPECT_THAT(names(events),
              ElementsAre("rclcpp_construct_ring_buffer", "rclcpp_buffer_to_ipb", "rclcpp_ring_buffer_clear"));
  EXPECT_EQ(events[0]->number("capacity"), 7);
  EXPECT_EQ(events[2]->handle("buffer"), events[0]->handle("buffer"));
}

}  // namespace
