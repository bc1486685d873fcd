// SPDX-License-Identifier: Apache-2.0
// The trace of an executor with several threads.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "launch_trace_testing/matchers.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace launch_trace_testing;
using namespace test_support;

constexpr const char* kGetNextReady = "ros2:rclcpp_executor_get_next_ready";
constexpr const char* kWaitForWork = "ros2:rclcpp_executor_wait_for_work";
constexpr const char* kExecute = "ros2:rclcpp_executor_execute";

class ExecutorThreadsTrace : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = sandbox_.directory() / "threads.launch.xml";
    std::ofstream(file) << R"(<launch>
  <trace session-name="threads" context-fields="procname vpid vtid" subbuffer-size-ust="1048576"/>
  <executable cmd=")" WORKER R"("/>
</launch>
)";
    const CommandResult result = run_command({LAUNCH_PROGRAM, file.string()});
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    trace_ = Trace(sandbox_.trace_directory() / "threads");
    ASSERT_THAT(trace_, LostNothing());
  }

  std::set<std::uint64_t> all(const std::string& name, const std::string& field) const {
    std::set<std::uint64_t> values;
    for (const Event* const each : event(name).select(trace_)) {
      values.insert(each->handle(field));
    }
    return values;
  }

  Sandbox sandbox_;
  Trace trace_;
};

TEST_F(ExecutorThreadsTrace, EveryThreadTellsWhatItDoesInOrder) {
  std::map<std::int64_t, std::string> last_of_executor;  // by thread
  std::map<std::int64_t, std::vector<std::uint64_t>> running;
  std::map<std::int64_t, bool> executing;  // the event came, but the callback has not begun
  std::int64_t waiter = 0;
  std::set<std::int64_t> threads_that_ran;
  for (const Event& event : trace_) {
    std::string& last = last_of_executor[event.vtid()];
    auto& callbacks = running[event.vtid()];
    if (event.name() == kGetNextReady || event.name() == kWaitForWork || event.name() == kExecute) {
      EXPECT_TRUE(callbacks.empty()) << event.name() << " within a callback";
      EXPECT_FALSE(executing[event.vtid()]) << event.name() << " before the callback of an execution";
    }
    if (event.name() == kGetNextReady || event.name() == kWaitForWork) {
      EXPECT_TRUE(waiter == 0 || waiter == event.vtid()) << event.name() << " while another thread waits";
      EXPECT_TRUE(event.name() == kGetNextReady || last == kGetNextReady) << "waits without having looked";
      waiter = event.name() == kWaitForWork ? event.vtid() : 0;
      last = event.name();
    } else if (event.name() == kExecute) {
      EXPECT_EQ(last, kGetNextReady) << "executes without having looked";
      executing[event.vtid()] = true;
      last = event.name();
    } else if (event.name() == "ros2:rmw_take" && event.number("taken") == 0) {
      executing[event.vtid()] = false;  // another thread was faster
    } else if (event.name() == "ros2:callback_start") {
      EXPECT_TRUE(executing[event.vtid()]) << "a callback that the executor does not tell of";
      executing[event.vtid()] = false;
      threads_that_ran.insert(event.vtid());
      callbacks.push_back(event.handle("callback"));
    } else if (event.name() == "ros2:callback_end") {
      ASSERT_FALSE(callbacks.empty()) << "an end without a start";
      EXPECT_EQ(callbacks.back(), event.handle("callback"));
      callbacks.pop_back();
    }
  }
  EXPECT_GE(threads_that_ran.size(), 2U);
  for (const auto& [thread, callbacks] : running) {
    EXPECT_TRUE(callbacks.empty()) << "a start without an end";
  }
}

TEST_F(ExecutorThreadsTrace, CallbacksOverlapWhereTheirGroupLetsThem) {
  ASSERT_THAT(trace_, HasEvents(event("ros2:rclcpp_subscription_callback_added"), exactly(1)));
  const std::uint64_t subscription = event("ros2:rclcpp_subscription_callback_added").first(trace_)->handle("callback");
  const std::set<std::uint64_t> timers = all("ros2:rclcpp_timer_callback_added", "callback");
  EXPECT_EQ(timers.size(), 2U);
  int running_timers = 0;
  int running_subscriptions = 0;
  int most_subscriptions = 0;
  for (const Event* const each : event("ros2:callback_*").select(trace_)) {
    const int change = each->name() == "ros2:callback_start" ? 1 : -1;
    if (timers.contains(each->handle("callback"))) {
      running_timers += change;
      EXPECT_LE(running_timers, 1);
    } else if (each->handle("callback") == subscription) {
      running_subscriptions += change;
      most_subscriptions = std::max(most_subscriptions, running_subscriptions);
    }
  }
  EXPECT_EQ(most_subscriptions, 2);
}

}  // namespace
