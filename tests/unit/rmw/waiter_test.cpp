// SPDX-License-Identifier: Apache-2.0
// The wait of one thread for entities, with entities that the test defines.
#include "rmw/waiter.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "wait/waitable.hpp"

namespace {

using rmw_fastrtps::GuardCondition;
using rmw_fastrtps::Waitable;
using rmw_fastrtps::Waiter;
using std::chrono::nanoseconds;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr nanoseconds kNoTime(0);
constexpr nanoseconds kForever(-1);

class Entity final : public Waitable {
 public:
  bool is_ready() override {
    ++asked;
    return ready;
  }
  void arrive() {
    ready = true;
    notify();
  }

  std::atomic_bool ready{false};
  int asked = 0;
};

class WaiterTest : public testing::Test {
 protected:
  void add(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      add(entities_.emplace_back(std::make_unique<Entity>()).get());
    }
  }
  void add(Entity* entity) { waiter_.add(as_data(entity)); }
  static void* as_data(Waitable* waitable) { return waitable; }
  std::vector<std::size_t> wait(nanoseconds timeout = kNoTime) {
    std::vector<std::size_t> ready;
    waiter_.wait(timeout, ready);
    return ready;
  }
  std::vector<int> asked() const {
    std::vector<int> asked;
    for (const auto& entity : entities_) {
      asked.push_back(entity->asked);
    }
    return asked;
  }

  std::vector<std::unique_ptr<Entity>> entities_;
  Waiter waiter_;
};

TEST_F(WaiterTest, ASinglePollAsksEachAndRepeatedOnesAskNoIdleEntity) {
  add(100);
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(asked(), Each(1));
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(asked(), Each(2));
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(asked(), Each(2));
}

TEST_F(WaiterTest, AsksOnlyWhatHasSomething) {
  add(100);
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  entities_[70]->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(70));
  entities_[70]->ready = false;
  EXPECT_THAT(wait(), IsEmpty());
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    EXPECT_EQ(entities_[i]->asked, i == 70 ? 3 : 1) << i;
  }
}

TEST_F(WaiterTest, FindsWhatWasReadyBefore) {
  add(3);
  entities_[1]->ready = true;
  EXPECT_THAT(wait(), ElementsAre(1));
  EXPECT_THAT(wait(), ElementsAre(1));
  EXPECT_THAT(wait(kForever), ElementsAre(1));
}

TEST_F(WaiterTest, TellsPositionsInAscendingOrder) {
  add(40);
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  entities_[30]->arrive();
  entities_[5]->arrive();
  entities_[12]->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(5, 12, 30));
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    entities_[entities_.size() - 1 - i]->arrive();
    all.push_back(i);
  }
  EXPECT_EQ(wait(kForever), all);
}

TEST_F(WaiterTest, IsWokenByAnotherThread) {
  add(2);
  std::thread other([this] { entities_[1]->arrive(); });
  EXPECT_THAT(wait(kForever), ElementsAre(1));
  other.join();
}

TEST_F(WaiterTest, WhatMayNotBeTakenEndsNoWaitAndIsFoundLater) {
  std::atomic_bool may_be_taken{true};
  add(1);
  Entity held_back;
  waiter_.add(as_data(&held_back), &may_be_taken);
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  may_be_taken = false;
  held_back.arrive();
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  entities_[0]->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(0));
  entities_[0]->ready = false;
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_EQ(held_back.asked, 1);
  may_be_taken = true;
  EXPECT_THAT(wait(), ElementsAre(1));
  waiter_.remove_from(0);
}

TEST_F(WaiterTest, AsksNoneOfTheOthersWhileManyAreHeldBack) {
  constexpr std::size_t kOthers = 100;
  constexpr std::size_t kHeldBack = 40;
  std::atomic_bool may_be_taken{true};
  add(kOthers);
  std::vector<std::unique_ptr<Entity>> held_back;
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < kHeldBack; ++i) {
    held_back.push_back(std::make_unique<Entity>());
    waiter_.add(as_data(held_back.back().get()), &may_be_taken);
    positions.push_back(kOthers + i);
  }
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  may_be_taken = false;
  for (const auto& entity : held_back) {
    entity->arrive();
    entity->arrive();
  }
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(wait(), IsEmpty());
  EXPECT_THAT(asked(), Each(1));
  entities_[7]->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(7));
  entities_[7]->ready = false;
  may_be_taken = true;
  EXPECT_EQ(wait(kForever), positions);
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    EXPECT_EQ(entities_[i]->asked, i == 7 ? 3 : 1) << i;
  }
  for (const auto& entity : held_back) {
    EXPECT_EQ(entity->asked, 2);
  }
  waiter_.remove_from(0);
}

TEST_F(WaiterTest, RegistrationsBehindOthersCanBeReplaced) {
  add(2);
  Entity first;
  Entity second;
  add(&first);
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  first.arrive();
  entities_[1]->arrive();
  waiter_.remove_from(2);
  add(&second);
  EXPECT_THAT(wait(kForever), ElementsAre(1));
  second.arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(1, 2));
  EXPECT_EQ(entities_[0]->asked, 1);
  EXPECT_EQ(first.asked, 1);
  EXPECT_TRUE(waiter_.has_from(0, {entities_[0].get(), entities_[1].get(), &second}));
  EXPECT_TRUE(waiter_.has_from(2, {&second}));
  EXPECT_FALSE(waiter_.has_from(2, {&first}));
  EXPECT_FALSE(waiter_.has_from(2, {}));
  waiter_.remove_from(2);
  EXPECT_TRUE(waiter_.has_from(2, {}));
}

TEST_F(WaiterTest, ADestroyedEntityIsNotTakenForAnotherAtItsAddress) {
  add(1);
  alignas(Entity) std::byte memory[sizeof(Entity)];
  auto* entity = new (memory) Entity;
  add(entity);
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  EXPECT_TRUE(waiter_.has_from(1, {as_data(entity)}));
  entity->~Entity();
  entity = new (memory) Entity;
  EXPECT_FALSE(waiter_.has_from(1, {as_data(entity)}));
  waiter_.remove_from(1);
  add(entity);
  EXPECT_TRUE(waiter_.has_from(1, {as_data(entity)}));
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  entity->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(1));
  entity->~Entity();
}

TEST_F(WaiterTest, ResetsGuardConditions) {
  GuardCondition condition;
  waiter_.add(as_data(&condition));
  condition.trigger();
  condition.trigger();
  EXPECT_THAT(wait(kForever), ElementsAre(0));
  EXPECT_THAT(wait(), IsEmpty());
  condition.trigger();
  EXPECT_THAT(wait(), ElementsAre(0));
  waiter_.remove_from(0);
}

TEST_F(WaiterTest, AnEntityCanBeRegisteredTwice) {
  add(1);
  add(entities_[0].get());
  EXPECT_THAT(wait(nanoseconds(1)), IsEmpty());
  entities_[0]->arrive();
  EXPECT_THAT(wait(kForever), ElementsAre(0, 1));
  waiter_.remove_from(1);
  EXPECT_THAT(wait(kForever), ElementsAre(0));
}

}  // namespace
