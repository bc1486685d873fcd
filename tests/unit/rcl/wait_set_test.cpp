// SPDX-License-Identifier: Apache-2.0
// Wait sets that are filled and waited with again and again.
#include <gmock/gmock.h>

#include <vector>

#include "rcl_test.hpp"

namespace {

using testing::ElementsAre;

constexpr int64_t kNoTime = 0;
constexpr std::nullptr_t kNull = nullptr;

class WaitSetConditions : public testing::Test {
 protected:
  struct Condition {
    explicit Condition(rcl_test::Context& context) {
      EXPECT_EQ(rcl_guard_condition_init(&handle, &context.handle, rcl_guard_condition_get_default_options()),
                RCL_RET_OK);
    }
    ~Condition() { EXPECT_EQ(rcl_guard_condition_fini(&handle), RCL_RET_OK); }
    void trigger() { EXPECT_EQ(rcl_trigger_guard_condition(&handle), RCL_RET_OK); }

    rcl_guard_condition_t handle = rcl_get_zero_initialized_guard_condition();
  };

  WaitSetConditions() {
    EXPECT_EQ(rcl_wait_set_init(&set_, 0, 4, 0, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
  }
  ~WaitSetConditions() override { EXPECT_EQ(rcl_wait_set_fini(&set_), RCL_RET_OK); }

  void add(Condition& condition) {
    EXPECT_EQ(rcl_wait_set_add_guard_condition(&set_, &condition.handle, nullptr), RCL_RET_OK);
  }
  // Adds a, b and `further`, and returns the entries after the wait.
  std::vector<const rcl_guard_condition_t*> left(std::vector<Condition*> further, rcl_ret_t expected) {
    EXPECT_EQ(rcl_wait_set_clear(&set_), RCL_RET_OK);
    add(a_);
    add(b_);
    for (Condition* condition : further) {
      add(*condition);
    }
    EXPECT_EQ(rcl_wait(&set_, kNoTime), expected);
    rcl_reset_error();
    return {set_.guard_conditions, set_.guard_conditions + set_.size_of_guard_conditions};
  }

  rcl_test::Context context_;
  Condition a_{context_};
  Condition b_{context_};
  Condition c_{context_};
  Condition d_{context_};
  rcl_wait_set_t set_ = rcl_get_zero_initialized_wait_set();
};

TEST_F(WaitSetConditions, WhatItIsGivenEachTimeIsFoundEachTime) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(left({}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
    b_.trigger();
    EXPECT_THAT(left({}, RCL_RET_OK), ElementsAre(kNull, &b_.handle, kNull, kNull));
    a_.trigger();
    b_.trigger();
    EXPECT_THAT(left({}, RCL_RET_OK), ElementsAre(&a_.handle, &b_.handle, kNull, kNull));
    a_.trigger();
    EXPECT_THAT(left({}, RCL_RET_OK), ElementsAre(&a_.handle, kNull, kNull, kNull));
  }
}

TEST_F(WaitSetConditions, AnotherWaitWithoutClearingWaitsForWhatWasLeft) {
  b_.trigger();
  EXPECT_THAT(left({}, RCL_RET_OK), ElementsAre(kNull, &b_.handle, kNull, kNull));
  b_.trigger();
  EXPECT_EQ(rcl_wait(&set_, kNoTime), RCL_RET_OK);
  EXPECT_EQ(set_.guard_conditions[0], nullptr);
  EXPECT_EQ(set_.guard_conditions[1], &b_.handle);
  EXPECT_EQ(rcl_wait(&set_, kNoTime), RCL_RET_TIMEOUT);
  rcl_reset_error();
}

TEST_F(WaitSetConditions, WhatIsAddedForOneWaitIsThereInThatWaitOnly) {
  c_.trigger();
  EXPECT_THAT(left({}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  EXPECT_THAT(left({&c_}, RCL_RET_OK), ElementsAre(kNull, kNull, &c_.handle, kNull));
  EXPECT_THAT(left({&c_}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  c_.trigger();
  d_.trigger();
  a_.trigger();
  EXPECT_THAT(left({&d_}, RCL_RET_OK), ElementsAre(&a_.handle, kNull, &d_.handle, kNull));
  EXPECT_THAT(left({&d_, &c_}, RCL_RET_OK), ElementsAre(kNull, kNull, kNull, &c_.handle));
  d_.trigger();
  EXPECT_THAT(left({&d_, &c_}, RCL_RET_OK), ElementsAre(kNull, kNull, &d_.handle, kNull));
  EXPECT_THAT(left({}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
}

TEST_F(WaitSetConditions, AnAddedOneMayBeAnotherAtTheSameAddress) {
  EXPECT_THAT(left({&c_}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  EXPECT_THAT(left({&c_}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  ASSERT_EQ(rcl_guard_condition_fini(&c_.handle), RCL_RET_OK);
  c_.handle = rcl_get_zero_initialized_guard_condition();
  ASSERT_EQ(rcl_guard_condition_init(&c_.handle, &context_.handle, rcl_guard_condition_get_default_options()),
            RCL_RET_OK);
  EXPECT_THAT(left({&c_}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  c_.trigger();
  EXPECT_THAT(left({&c_}, RCL_RET_OK), ElementsAre(kNull, kNull, &c_.handle, kNull));
}

// Timers on simulated time, and one on steady time that is never due.
class WaitSetTimers : public testing::Test {
 protected:
  WaitSetTimers() {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_clock_init(RCL_ROS_TIME, &simulated_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_init(RCL_STEADY_TIME, &steady_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_enable_ros_time_override(&simulated_), RCL_RET_OK);
    set_time(100);
    EXPECT_EQ(rcl_wait_set_init(&set_, 0, 1, 4, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
    EXPECT_EQ(rcl_guard_condition_init(&end_, &context_.handle, rcl_guard_condition_get_default_options()), RCL_RET_OK);
    init(timers_[0], &simulated_, 30);
    init(timers_[1], &simulated_, 10);
    init(timers_[2], &steady_, int64_t{1} << 60);
    init(timers_[3], &simulated_, 20);
  }
  ~WaitSetTimers() override {
    EXPECT_EQ(rcl_wait_set_fini(&set_), RCL_RET_OK);
    for (rcl_timer_t& timer : timers_) {
      EXPECT_EQ(rcl_timer_fini(&timer), RCL_RET_OK);
    }
    EXPECT_EQ(rcl_guard_condition_fini(&end_), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&simulated_), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&steady_), RCL_RET_OK);
  }

  void init(rcl_timer_t& timer, rcl_clock_t* clock, int64_t period) {
    EXPECT_EQ(rcl_timer_init2(&timer, clock, &context_.handle, period, nullptr, rcl_get_default_allocator(), true),
              RCL_RET_OK);
  }
  void set_time(int64_t time) { EXPECT_EQ(rcl_set_ros_time_override(&simulated_, time), RCL_RET_OK); }
  // The numbers of the timers that a wait leaves; these timers are called.
  std::vector<std::ptrdiff_t> call_ready() {
    EXPECT_EQ(rcl_wait_set_clear(&set_), RCL_RET_OK);
    EXPECT_EQ(rcl_wait_set_add_guard_condition(&set_, &end_, nullptr), RCL_RET_OK);
    for (const rcl_timer_t& timer : timers_) {
      EXPECT_EQ(rcl_wait_set_add_timer(&set_, &timer, nullptr), RCL_RET_OK);
    }
    const rcl_ret_t result = rcl_wait(&set_, kNoTime);
    std::vector<std::ptrdiff_t> ready;
    for (size_t i = 0; i < set_.size_of_timers; ++i) {
      if (set_.timers[i] != nullptr) {
        ready.push_back(set_.timers[i] - timers_);
        EXPECT_EQ(rcl_timer_call(&timers_[ready.back()]), RCL_RET_OK);
      }
    }
    EXPECT_EQ(result == RCL_RET_OK || !ready.empty(), result == RCL_RET_OK);
    rcl_reset_error();
    return ready;
  }

  rcl_test::Context context_;
  rcl_clock_t simulated_{};
  rcl_clock_t steady_{};
  rcl_guard_condition_t end_ = rcl_get_zero_initialized_guard_condition();
  rcl_timer_t timers_[4]{};
  rcl_wait_set_t set_ = rcl_get_zero_initialized_wait_set();
};

TEST_F(WaitSetTimers, EachIsLeftWhenItIsDue) {
  const std::vector<std::vector<std::ptrdiff_t>> expected = {{}, {1}, {1, 3}, {0, 1}, {1, 3}, {1}};
  for (size_t i = 0; i < expected.size(); ++i) {
    set_time(100 + static_cast<int64_t>(i) * 10);
    EXPECT_EQ(call_ready(), expected[i]) << i;
    EXPECT_EQ(call_ready(), std::vector<std::ptrdiff_t>()) << i;
  }
}

TEST_F(WaitSetTimers, ACancelledOneComesBackWithItsReset) {
  EXPECT_THAT(call_ready(), ElementsAre());
  ASSERT_EQ(rcl_timer_cancel(&timers_[1]), RCL_RET_OK);
  set_time(120);
  EXPECT_THAT(call_ready(), ElementsAre(3));
  ASSERT_EQ(rcl_timer_reset(&timers_[1]), RCL_RET_OK);
  EXPECT_THAT(call_ready(), ElementsAre());
  set_time(130);
  EXPECT_THAT(call_ready(), ElementsAre(0, 1));
}

TEST_F(WaitSetTimers, AShorterPeriodCountsFromAReset) {
  EXPECT_THAT(call_ready(), ElementsAre());
  int64_t old_period = 0;
  ASSERT_EQ(rcl_timer_exchange_period(&timers_[0], 1, &old_period), RCL_RET_OK);
  ASSERT_EQ(rcl_timer_reset(&timers_[0]), RCL_RET_OK);
  EXPECT_THAT(call_ready(), ElementsAre());
  set_time(101);
  EXPECT_THAT(call_ready(), ElementsAre(0));
  set_time(102);
  EXPECT_THAT(call_ready(), ElementsAre(0));
}

TEST_F(WaitSetTimers, TimeThatJumpsBackMakesThemDueAgain) {
  set_time(200);
  EXPECT_THAT(call_ready(), ElementsAre(0, 1, 3));
  set_time(50);
  EXPECT_THAT(call_ready(), ElementsAre());
  set_time(60);
  EXPECT_THAT(call_ready(), ElementsAre(1));
}

}  // namespace
