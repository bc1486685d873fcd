// Waiting again for what a wait set keeps.
#include <gmock/gmock.h>

#include <vector>

#include "rcl/wait_restore.h"
#include "rcl_test.hpp"

namespace {

using testing::ElementsAre;

constexpr int64_t kNoTime = 0;
constexpr std::nullptr_t kNull = nullptr;

class WaitSetKeeps : public testing::Test {
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

  WaitSetKeeps() {
    EXPECT_EQ(rcl_wait_set_init(&set_, 0, 4, 0, 0, 0, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
    add(a_);
    add(b_);
    EXPECT_EQ(rcl_wait_set_keep(&set_), RCL_RET_OK);
  }
  ~WaitSetKeeps() override { EXPECT_EQ(rcl_wait_set_fini(&set_), RCL_RET_OK); }

  void add(Condition& condition) {
    EXPECT_EQ(rcl_wait_set_add_guard_condition(&set_, &condition.handle, nullptr), RCL_RET_OK);
  }
  // Restores the set, adds `further`, and gives the entries after the wait.
  std::vector<const rcl_guard_condition_t*> left(std::vector<Condition*> further, rcl_ret_t expected) {
    EXPECT_EQ(rcl_wait_set_restore(&set_), RCL_RET_OK);
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

TEST_F(WaitSetKeeps, WhatItIsGivenEachTimeIsFoundEachTime) {
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

TEST_F(WaitSetKeeps, WhatIsAddedForOneWaitIsThereInThatWaitOnly) {
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

TEST_F(WaitSetKeeps, AnAddedOneMayBeAnotherAtTheSameAddress) {
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

TEST_F(WaitSetKeeps, ClearingForgets) {
  EXPECT_THAT(left({}, RCL_RET_TIMEOUT), ElementsAre(kNull, kNull, kNull, kNull));
  ASSERT_EQ(rcl_wait_set_clear(&set_), RCL_RET_OK);
  EXPECT_EQ(rcl_wait_set_restore(&set_), RCL_RET_WAIT_SET_EMPTY);
  rcl_reset_error();
  add(d_);
  add(a_);
  ASSERT_EQ(rcl_wait_set_keep(&set_), RCL_RET_OK);
  a_.trigger();
  b_.trigger();
  EXPECT_THAT(left({}, RCL_RET_OK), ElementsAre(kNull, &a_.handle, kNull, kNull));
  d_.trigger();
  EXPECT_THAT(left({&b_}, RCL_RET_OK), ElementsAre(&d_.handle, kNull, &b_.handle, kNull));
}

}  // namespace
