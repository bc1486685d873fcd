// SPDX-License-Identifier: Apache-2.0
// The waitables of an executor, wait by wait, with groups that the test makes busy.
#include "executor/asked_waitables.hpp"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <rcl/rmw_entity.hpp>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rclcpp::AskedWaitables;
using rclcpp::WaitedEntities;
using testing::ElementsAre;
using testing::IsEmpty;

// Ready after ring().
class Bell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override {
    ++asked;
    ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, &condition_->get_rcl_guard_condition(), &index_), RCL_RET_OK);
  }
  bool is_ready(const rcl_wait_set_t& wait_set) override { return wait_set.guard_conditions[index_] != nullptr; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override {}

  void ring() { condition_->trigger(); }
  void replace_condition() {
    condition_.reset();
    condition_ = std::make_unique<rclcpp::GuardCondition>();
  }
  void* rmw_entity() const { return rcl::rmw_entity_of(&condition_->get_rcl_guard_condition()); }

  int asked = 0;

 private:
  std::unique_ptr<rclcpp::GuardCondition> condition_ = std::make_unique<rclcpp::GuardCondition>();
  size_t index_ = 0;
};

// Three bells, each in a group of its own.
class AskedWaitablesTest : public RosTest {
 protected:
  static constexpr std::size_t kBells = 3;

  AskedWaitablesTest() : waitables_(rclcpp::contexts::get_global_default_context()->get_rcl_context()) {
    for (std::size_t i = 0; i < kBells; ++i) {
      bells_[i] = std::make_shared<Bell>();
      is_free_[i] = std::make_shared<std::atomic_bool>(true);
      waited_.groups.push_back({{}, is_free_[i]});
      waited_.waitables.push_back({bells_[i], i});
    }
  }

  void ask() { waitables_.ask(waited_, waiter_, 0); }
  // The bells that the wait finds ready, after ask().
  std::vector<std::size_t> wait() {
    std::vector<std::size_t> positions;
    waiter_.wait(std::chrono::nanoseconds(1), positions);
    std::vector<rclcpp::detail::ReadyEntity> ready;
    waitables_.append_ready(waited_, positions.data(), positions.data() + positions.size(), ready);
    waitables_.release();
    std::vector<std::size_t> bells;
    for (const rclcpp::detail::ReadyEntity& entity : ready) {
      const auto waitable = std::get<rclcpp::Waitable::WeakPtr>(entity.entity).lock();
      for (std::size_t i = 0; i < kBells; ++i) {
        if (waitable == bells_[i]) {
          bells.push_back(i);
        }
      }
    }
    return bells;
  }
  std::vector<std::size_t> ask_and_wait() {
    ask();
    return wait();
  }

  std::array<std::shared_ptr<Bell>, kBells> bells_;
  std::array<std::shared_ptr<std::atomic_bool>, kBells> is_free_;
  WaitedEntities waited_;
  rmw_fastrtps::Waiter waiter_;
  AskedWaitables waitables_;
};

TEST_F(AskedWaitablesTest, ABusyOneStaysRegisteredAndIsNotAsked) {
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  const std::vector<void*> all = {bells_[0]->rmw_entity(), bells_[1]->rmw_entity(), bells_[2]->rmw_entity()};
  EXPECT_TRUE(waiter_.has_from(0, all));
  *is_free_[1] = false;
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  EXPECT_TRUE(waiter_.has_from(0, all));
  EXPECT_EQ(bells_[0]->asked, 2);
  EXPECT_EQ(bells_[1]->asked, 1);
  EXPECT_EQ(bells_[2]->asked, 2);
  *is_free_[1] = true;
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  EXPECT_TRUE(waiter_.has_from(0, all));
  EXPECT_EQ(bells_[1]->asked, 2);
}

TEST_F(AskedWaitablesTest, WhatABusyOneWasTriggeredForEndsNoWaitAndIsFoundLater) {
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  *is_free_[0] = false;
  bells_[0]->ring();
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  bells_[2]->ring();
  EXPECT_THAT(ask_and_wait(), ElementsAre(2));
  *is_free_[0] = true;
  bells_[1]->ring();
  EXPECT_THAT(ask_and_wait(), ElementsAre(0, 1));
  EXPECT_THAT(ask_and_wait(), IsEmpty());
}

TEST_F(AskedWaitablesTest, AGroupThatIsFreeAfterAllDuringTheWaitIsLeftToTheNextOne) {
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  *is_free_[0] = false;
  bells_[0]->ring();
  ask();
  *is_free_[0] = true;
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(ask_and_wait(), ElementsAre(0));
}

TEST_F(AskedWaitablesTest, ABusyOneMayReplaceWhatItIsWokenBy) {
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  *is_free_[0] = false;
  bells_[0]->ring();
  ask();
  bells_[0]->replace_condition();  // while the wait is going on
  *is_free_[0] = true;
  EXPECT_THAT(wait(), IsEmpty());
  *is_free_[0] = false;
  bells_[1]->ring();
  EXPECT_THAT(ask_and_wait(), ElementsAre(1));
  EXPECT_TRUE(waiter_.has_from(0, {bells_[1]->rmw_entity(), bells_[2]->rmw_entity()}));
  *is_free_[0] = true;
  bells_[0]->ring();
  EXPECT_THAT(ask_and_wait(), ElementsAre(0));
}

TEST_F(AskedWaitablesTest, OnesThatNoLongerLiveLeave) {
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  *is_free_[1] = false;
  EXPECT_THAT(ask_and_wait(), IsEmpty());
  bells_[1].reset();
  bells_[2]->ring();
  EXPECT_THAT(ask_and_wait(), ElementsAre(2));
  EXPECT_TRUE(waiter_.has_from(0, {bells_[0]->rmw_entity(), bells_[2]->rmw_entity()}));
}

}  // namespace
