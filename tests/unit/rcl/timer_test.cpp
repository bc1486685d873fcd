// SPDX-License-Identifier: Apache-2.0
// Timers on simulated time: the test sets every moment.
#include "rcl_test.hpp"

namespace {

using rcl_test::take_error;

constexpr int64_t kMillisecond = 1000000;

class Timer : public testing::Test {
 protected:
  Timer() {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_clock_init(RCL_ROS_TIME, &clock_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_enable_ros_time_override(&clock_), RCL_RET_OK);
    set_time(1000 * kMillisecond);
  }
  ~Timer() override {
    EXPECT_EQ(rcl_timer_fini(&timer_), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&clock_), RCL_RET_OK);
  }

  void start(int64_t period, bool autostart = true) {
    ASSERT_EQ(
        rcl_timer_init2(&timer_, &clock_, &context_.handle, period, nullptr, rcl_get_default_allocator(), autostart),
        RCL_RET_OK)
        << take_error();
  }
  void set_time(int64_t time) { EXPECT_EQ(rcl_set_ros_time_override(&clock_, time), RCL_RET_OK); }
  bool is_ready() {
    bool ready = false;
    EXPECT_EQ(rcl_timer_is_ready(&timer_, &ready), RCL_RET_OK);
    return ready;
  }
  int64_t until_next_call() {
    int64_t time = 0;
    EXPECT_EQ(rcl_timer_get_time_until_next_call(&timer_, &time), RCL_RET_OK);
    return time;
  }

  rcl_test::Context context_;
  rcl_clock_t clock_{};
  rcl_timer_t timer_ = rcl_get_zero_initialized_timer();
};

TEST_F(Timer, IsDueOnePeriodAfterItsStart) {
  start(10 * kMillisecond);
  EXPECT_FALSE(is_ready());
  EXPECT_EQ(until_next_call(), 10 * kMillisecond);
  set_time(1010 * kMillisecond);
  EXPECT_TRUE(is_ready());
  rcl_timer_call_info_t info;
  ASSERT_EQ(rcl_timer_call_with_info(&timer_, &info), RCL_RET_OK);
  EXPECT_EQ(info.expected_call_time, 1010 * kMillisecond);
  EXPECT_EQ(info.actual_call_time, 1010 * kMillisecond);
  EXPECT_FALSE(is_ready());
}

TEST_F(Timer, StaysInPhaseWhenItIsCalledLate) {
  start(10 * kMillisecond);
  set_time(1013 * kMillisecond);
  ASSERT_EQ(rcl_timer_call(&timer_), RCL_RET_OK);
  EXPECT_EQ(until_next_call(), 7 * kMillisecond);
}

TEST_F(Timer, SkipsPeriodsThatWereMissed) {
  start(10 * kMillisecond);
  set_time(1055 * kMillisecond);
  ASSERT_EQ(rcl_timer_call(&timer_), RCL_RET_OK);
  EXPECT_EQ(until_next_call(), 5 * kMillisecond);
  set_time(1080 * kMillisecond);
  ASSERT_EQ(rcl_timer_call(&timer_), RCL_RET_OK);
  EXPECT_EQ(until_next_call(), 10 * kMillisecond);
}

TEST_F(Timer, OfPeriodZeroIsAlwaysReady) {
  start(0);
  EXPECT_TRUE(is_ready());
  ASSERT_EQ(rcl_timer_call(&timer_), RCL_RET_OK);
  EXPECT_TRUE(is_ready());
}

TEST_F(Timer, CancelledIsNeverReadyUntilReset) {
  start(10 * kMillisecond);
  ASSERT_EQ(rcl_timer_cancel(&timer_), RCL_RET_OK);
  set_time(2000 * kMillisecond);
  EXPECT_FALSE(is_ready());
  EXPECT_EQ(rcl_timer_call(&timer_), RCL_RET_TIMER_CANCELED);
  EXPECT_EQ(take_error(), "the timer is canceled");
  ASSERT_EQ(rcl_timer_reset(&timer_), RCL_RET_OK);
  EXPECT_EQ(until_next_call(), 10 * kMillisecond);
}

TEST_F(Timer, WithoutAutostartBeginsCancelled) {
  start(10 * kMillisecond, false);
  bool canceled = false;
  ASSERT_EQ(rcl_timer_is_canceled(&timer_, &canceled), RCL_RET_OK);
  EXPECT_TRUE(canceled);
}

TEST_F(Timer, StartsAnewWhenTimeGoesBack) {
  start(10 * kMillisecond);
  set_time(500 * kMillisecond);
  EXPECT_EQ(until_next_call(), 10 * kMillisecond);
}

TEST_F(Timer, KeepsItsDistanceWhenSimulationEnds) {
  start(3600 * 1000 * kMillisecond);
  set_time(1600 * 1000 * kMillisecond);
  const int64_t left = until_next_call();
  ASSERT_EQ(rcl_disable_ros_time_override(&clock_), RCL_RET_OK);
  // The system clock goes on meanwhile.
  EXPECT_LE(until_next_call(), left);
  EXPECT_GT(until_next_call(), left - 60 * 1000 * kMillisecond);
}

TEST_F(Timer, TellsTheTimeBetweenCallsToItsCallback) {
  static int64_t told = 0;
  ASSERT_EQ(rcl_timer_init(
                &timer_, &clock_, &context_.handle, 10 * kMillisecond,
                [](rcl_timer_t*, int64_t last_call_time) { told = last_call_time; }, rcl_get_default_allocator()),
            RCL_RET_OK);
  set_time(1012 * kMillisecond);
  ASSERT_EQ(rcl_timer_call(&timer_), RCL_RET_OK);
  EXPECT_EQ(told, 12 * kMillisecond);
}

TEST_F(Timer, WakesAWaitWhenItsTimeComes) {
  start(10 * kMillisecond);
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 0, 0, 1, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer_, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, 0), RCL_RET_TIMEOUT);
  EXPECT_EQ(wait_set.timers[0], nullptr);

  set_time(1010 * kMillisecond);
  ASSERT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer_, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, -1), RCL_RET_OK);
  EXPECT_EQ(wait_set.timers[0], &timer_);
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
}

TEST_F(Timer, IsWaitedForAgainBesideAGuardCondition) {
  start(10 * kMillisecond);
  rcl_guard_condition_t guard_condition = rcl_get_zero_initialized_guard_condition();
  ASSERT_EQ(rcl_guard_condition_init(&guard_condition, &context_.handle, rcl_guard_condition_get_default_options()),
            RCL_RET_OK);
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 0, 1, 1, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer_, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, 0), RCL_RET_TIMEOUT);
  EXPECT_EQ(wait_set.timers[0], nullptr);

  ASSERT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer_, nullptr), RCL_RET_OK);
  size_t index = 7;
  ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, &guard_condition, &index), RCL_RET_OK);
  EXPECT_EQ(index, 0u);
  ASSERT_EQ(rcl_trigger_guard_condition(&guard_condition), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, -1), RCL_RET_OK);
  EXPECT_EQ(wait_set.timers[0], nullptr);
  EXPECT_EQ(wait_set.guard_conditions[0], &guard_condition);

  set_time(1010 * kMillisecond);
  ASSERT_EQ(rcl_wait_set_clear(&wait_set), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer_, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, -1), RCL_RET_OK);
  EXPECT_EQ(wait_set.timers[0], &timer_);
  EXPECT_EQ(wait_set.guard_conditions[0], nullptr);
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
  EXPECT_EQ(rcl_guard_condition_fini(&guard_condition), RCL_RET_OK);
}

TEST_F(Timer, RefusesANegativePeriod) {
  EXPECT_EQ(rcl_timer_init(&timer_, &clock_, &context_.handle, -1, nullptr, rcl_get_default_allocator()),
            RCL_RET_INVALID_ARGUMENT);
  EXPECT_EQ(take_error(), "a timer period must not be negative");
}

TEST(WaitSet, WithNothingToWaitForSaysSo) {
  rcl_test::Context context;
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 1, 0, 0, 0, 0, 0, &context.handle, rcl_get_default_allocator()), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, 0), RCL_RET_WAIT_SET_EMPTY);
  EXPECT_EQ(take_error(), "there is nothing to wait for in the wait set");
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
}

TEST(SteadyTimer, EndsAWaitThatWouldLastForever) {
  rcl_test::Context context;
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_clock_t clock{};
  ASSERT_EQ(rcl_clock_init(RCL_STEADY_TIME, &clock, &allocator), RCL_RET_OK);
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  ASSERT_EQ(rcl_timer_init(&timer, &clock, &context.handle, 5 * kMillisecond, nullptr, allocator), RCL_RET_OK);
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 0, 0, 1, 0, 0, 0, &context.handle, allocator), RCL_RET_OK);
  ASSERT_EQ(rcl_wait_set_add_timer(&wait_set, &timer, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_wait(&wait_set, -1), RCL_RET_OK);
  EXPECT_EQ(wait_set.timers[0], &timer);
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
  EXPECT_EQ(rcl_timer_fini(&timer), RCL_RET_OK);
  EXPECT_EQ(rcl_clock_fini(&clock), RCL_RET_OK);
}

TEST_F(Timer, TellsOfResetsAndOfJumpsOnlyWhoAsksForThem) {
  start(10 * kMillisecond);
  size_t told = 0;
  const auto count = [](const void* user_data, size_t number) {
    *static_cast<size_t*>(const_cast<void*>(user_data)) += number;
  };
  ASSERT_EQ(rcl_timer_set_on_reset_callback(&timer_, count, &told), RCL_RET_OK);
  set_time(1005 * kMillisecond);
  EXPECT_EQ(told, 0u);
  EXPECT_EQ(rcl_timer_reset(&timer_), RCL_RET_OK);
  EXPECT_EQ(told, 1u);
  ASSERT_EQ(rcl_timer_set_on_change_callback(&timer_, count, &told), RCL_RET_OK);
  set_time(1006 * kMillisecond);
  EXPECT_EQ(told, 2u);
  EXPECT_EQ(rcl_timer_reset(&timer_), RCL_RET_OK);
  EXPECT_EQ(told, 3u);
  ASSERT_EQ(rcl_timer_set_on_change_callback(&timer_, nullptr, nullptr), RCL_RET_OK);
  EXPECT_EQ(rcl_timer_reset(&timer_), RCL_RET_OK);
  EXPECT_EQ(told, 3u);
}

TEST(Time, HasADifferenceOnOneClock) {
  const rcl_time_point_t start{5, RCL_ROS_TIME};
  rcl_time_point_t finish{3, RCL_ROS_TIME};
  rcl_duration_t difference{};
  EXPECT_EQ(rcl_difference_times(&start, &finish, &difference), RCL_RET_OK);
  EXPECT_EQ(difference.nanoseconds, -2);
  finish.clock_type = RCL_STEADY_TIME;
  EXPECT_EQ(rcl_difference_times(&start, &finish, &difference), RCL_RET_ERROR);
  EXPECT_EQ(take_error(), "two times of different clocks have no difference");
  EXPECT_EQ(rcl_difference_times(&start, nullptr, &difference), RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
}

}  // namespace
