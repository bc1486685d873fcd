// SPDX-License-Identifier: Apache-2.0
// The wait of an executor. The waiter of rmw has the list of registered entities and answers with positions in it. This
// class knows the entity at each position. After a wait it looks only at entities that are ready and at the next
// timers, since thousands of entities may be idle.
#pragma once

#include <rcl/context.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <rmw/waiter.hpp>
#include <vector>

#include "executor/asked_waitables.hpp"
#include "executor/timer_queue.hpp"
#include "executor/waited_entities.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/guard_condition.hpp"

namespace rclcpp {

// For one thread at a time.
class ExecutorWait {
 public:
  // `interrupt` ends the wait that is going on. If there is none, the next wait ends at once.
  ExecutorWait(const std::shared_ptr<rcl_context_t>& context, const GuardCondition& interrupt);

  // Replaces the entities of the following waits. Returns the former ones.
  WaitedEntities exchange(WaitedEntities waited);

  // Waits until an entity is ready or the timeout is over. A negative timeout never ends. Appends the entities that are
  // ready. Throws if rcl reports an error, and passes on exceptions of waitables.
  void wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

 private:
  void register_all();
  void wait_for_ready(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

  // The positions in the waiter: first `waited_.entities`, then the interrupt, the guard conditions of the timers, and
  // the entities of the waitables.
  std::size_t interrupt_position() const { return waited_.entities.size(); }
  std::size_t first_of_waitables() const { return interrupt_position() + 1 + waited_.timers.size(); }

  const GuardCondition& interrupt_;
  WaitedEntities waited_;
  bool is_registered_ = false;
  rmw_fastrtps::Waiter waiter_;
  TimerQueue timers_;
  AskedWaitables waitables_;
  // The results of one wait:
  std::vector<std::size_t> positions_;
  std::vector<std::size_t> due_;  // indices of timers
};

}  // namespace rclcpp
