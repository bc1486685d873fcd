// SPDX-License-Identifier: Apache-2.0
// The timers of an executor by the time at which they are due: three on simulated time, and one on steady time that is
// never due.
#include "executor/timer_queue.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <utility>
#include <vector>

namespace {

using rclcpp::TimerQueue;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kNeverDue = std::int64_t{1} << 60;

class TimerQueueTest : public testing::Test {
 protected:
  TimerQueueTest() {
    context_->init(0, nullptr);
    rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_clock_init(RCL_ROS_TIME, &simulated_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_init(RCL_STEADY_TIME, &steady_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_enable_ros_time_override(&simulated_), RCL_RET_OK);
    set_time(100);
    add(&simulated_, 30);
    add(&simulated_, 10);
    add(&steady_, kNeverDue);
    add(&simulated_, 20);
    queue_.assign(timers_);
  }
  ~TimerQueueTest() override {
    queue_.assign({});
    handles_.clear();
    EXPECT_EQ(rcl_clock_fini(&simulated_), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&steady_), RCL_RET_OK);
    context_->shutdown("the test is over");
  }

  void add(rcl_clock_t* clock, std::int64_t period) {
    std::shared_ptr<rcl_timer_t> timer(new rcl_timer_t(rcl_get_zero_initialized_timer()), [](rcl_timer_t* handle) {
      EXPECT_EQ(rcl_timer_fini(handle), RCL_RET_OK);
      delete handle;
    });
    EXPECT_EQ(rcl_timer_init2(timer.get(), clock, context_->get_rcl_context().get(), period, nullptr,
                              rcl_get_default_allocator(), true),
              RCL_RET_OK);
    timers_.push_back({timer.get(), &may_be_taken_});
    handles_.push_back(std::move(timer));
  }
  rcl_timer_t* timer(std::size_t index) { return handles_[index].get(); }
  void set_time(std::int64_t time) { EXPECT_EQ(rcl_set_ros_time_override(&simulated_, time), RCL_RET_OK); }
  // The indices of the timers that are due; these timers are called.
  std::vector<std::size_t> call_due() {
    std::vector<std::size_t> due;
    const bool is_due = queue_.time_until_first() <= 0;
    queue_.append_due(due);
    EXPECT_EQ(is_due, !due.empty());
    for (const std::size_t index : due) {
      EXPECT_EQ(rcl_timer_call(timer(index)), RCL_RET_OK);
    }
    return due;
  }

  const rclcpp::Context::SharedPtr context_ = std::make_shared<rclcpp::Context>();
  rcl_clock_t simulated_{};
  rcl_clock_t steady_{};
  const std::atomic_bool may_be_taken_{true};
  std::vector<std::shared_ptr<rcl_timer_t>> handles_;
  std::vector<TimerQueue::Timer> timers_;
  TimerQueue queue_;
};

TEST_F(TimerQueueTest, IsNeverDueWithoutTimers) {
  queue_.assign({});
  EXPECT_EQ(queue_.time_until_first(), TimerQueue::kNever);
  EXPECT_THAT(call_due(), IsEmpty());
}

TEST_F(TimerQueueTest, TellsTheTimeUntilTheFirst) {
  EXPECT_EQ(queue_.time_until_first(), 10);
  set_time(107);
  EXPECT_EQ(queue_.time_until_first(), 3);
}

TEST_F(TimerQueueTest, TellsWhichIsFirstAndOfEqualOnesTheOneOfTheLowestIndex) {
  EXPECT_EQ(queue_.first().index, 1U);
  set_time(120);
  ASSERT_EQ(rcl_timer_call(timer(3)), RCL_RET_OK);  // due at 140 then
  ASSERT_EQ(rcl_timer_call(timer(1)), RCL_RET_OK);  // due at 130, as timer 0
  const TimerQueue::First first = queue_.first();
  EXPECT_EQ(first.index, 0U);
  EXPECT_EQ(first.time_until, 10);
}

TEST_F(TimerQueueTest, EachIsDueInItsTime) {
  const std::vector<std::vector<std::size_t>> expected = {{}, {1}, {1, 3}, {0, 1}, {1, 3}, {1}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    set_time(100 + static_cast<std::int64_t>(i) * 10);
    EXPECT_EQ(call_due(), expected[i]) << i;
    EXPECT_THAT(call_due(), IsEmpty()) << i;
  }
}

TEST_F(TimerQueueTest, ACancelledTimerComesBackAfterItsReset) {
  EXPECT_THAT(call_due(), IsEmpty());
  ASSERT_EQ(rcl_timer_cancel(timer(1)), RCL_RET_OK);
  set_time(120);
  EXPECT_THAT(call_due(), ElementsAre(3));
  ASSERT_EQ(rcl_timer_reset(timer(1)), RCL_RET_OK);
  queue_.forget_times();
  EXPECT_THAT(call_due(), IsEmpty());
  set_time(130);
  EXPECT_THAT(call_due(), ElementsAre(0, 1));
}

TEST_F(TimerQueueTest, AShorterPeriodCountsFromAReset) {
  EXPECT_THAT(call_due(), IsEmpty());
  std::int64_t old_period = 0;
  ASSERT_EQ(rcl_timer_exchange_period(timer(0), 1, &old_period), RCL_RET_OK);
  ASSERT_EQ(rcl_timer_reset(timer(0)), RCL_RET_OK);
  queue_.forget_times();
  EXPECT_THAT(call_due(), IsEmpty());
  set_time(101);
  EXPECT_THAT(call_due(), ElementsAre(0));
  set_time(102);
  EXPECT_THAT(call_due(), ElementsAre(0));
}

TEST_F(TimerQueueTest, TimeThatJumpsBackMakesThemDueAgain) {
  set_time(200);
  EXPECT_THAT(call_due(), ElementsAre(0, 1, 3));
  set_time(50);
  queue_.forget_times();
  EXPECT_THAT(call_due(), IsEmpty());
  set_time(60);
  EXPECT_THAT(call_due(), ElementsAre(1));
}

TEST_F(TimerQueueTest, WhatMayNotBeTakenIsNotDueUntilItMay) {
  std::atomic_bool other{true};
  timers_[1].may_be_taken = &other;
  queue_.assign(timers_);
  EXPECT_EQ(queue_.time_until_first(), 10);
  other = false;
  EXPECT_EQ(queue_.time_until_first(), 20);
  set_time(120);
  EXPECT_THAT(call_due(), ElementsAre(3));
  other = true;
  EXPECT_THAT(call_due(), ElementsAre(1));
}

TEST_F(TimerQueueTest, IsDueAtTheEndOfAWaitInWhichItBecameFree) {
  std::atomic_bool other{false};
  timers_[1].may_be_taken = &other;
  queue_.assign(timers_);
  set_time(110);
  EXPECT_EQ(queue_.time_until_first(), 10);
  other = true;
  std::vector<std::size_t> due;
  queue_.append_due(due);
  EXPECT_THAT(due, ElementsAre(1));
}

TEST_F(TimerQueueTest, LeavesOutWhatWasTakenUntilItIsPutBack) {
  std::vector<std::size_t> due;
  set_time(130);
  queue_.take_due(due);
  EXPECT_THAT(due, ElementsAre(1, 3, 0));  // by their times
  due.clear();
  queue_.forget_times();
  queue_.take_due(due);
  EXPECT_THAT(due, IsEmpty());
  queue_.put_back(3);
  EXPECT_EQ(rcl_timer_call(timer(1)), RCL_RET_OK);
  queue_.put_back(1);
  queue_.take_due(due);
  EXPECT_THAT(due, ElementsAre(3));
  set_time(140);
  due.clear();
  queue_.take_due(due);
  EXPECT_THAT(due, ElementsAre(1));
}

TEST_F(TimerQueueTest, LeavesOutWhatIsRememberedFromBefore) {
  set_time(130);
  queue_.assign(timers_);
  queue_.leave_out(1);
  std::vector<std::size_t> due;
  queue_.take_due(due);
  EXPECT_THAT(due, ElementsAre(3, 0));
  EXPECT_EQ(rcl_timer_cancel(timer(1)), RCL_RET_OK);
  queue_.put_back(1);
  due.clear();
  queue_.take_due(due);
  EXPECT_THAT(due, IsEmpty());
}

}  // namespace
