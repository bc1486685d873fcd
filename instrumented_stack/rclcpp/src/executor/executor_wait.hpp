// SPDX-License-Identifier: Apache-2.0
// How an executor waits. rmw keeps the list of what is registered and answers with positions in it; here is what stands
// at each position. Nothing is looked at but what is ready and what comes next: there may be thousands of entities that
// have nothing to do.
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
  // `interrupt` ends a wait, the next one if none is going on.
  ExecutorWait(const std::shared_ptr<rcl_context_t>& context, const GuardCondition& interrupt);

  // Waits for these from now on, and hands over what it waited for before.
  WaitedEntities exchange(WaitedEntities waited);

  // Waits until something is ready or the time is over (negative: never), and appends what is ready. Throws if rcl
  // reports an error, and what waitables throw.
  void wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

 private:
  void register_all();
  void wait_for_ready(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

  // The positions are those of waited_.entities, then the interrupt, the guard conditions of the timers, and what
  // waitables bring.
  std::size_t interrupt_position() const { return waited_.entities.size(); }
  std::size_t first_of_waitables() const { return interrupt_position() + 1 + waited_.timers.size(); }

  const GuardCondition& interrupt_;
  WaitedEntities waited_;
  bool is_registered_ = false;
  rmw_fastrtps::Waiter waiter_;
  TimerQueue timers_;
  AskedWaitables waitables_;
  // Of one wait:
  std::vector<std::size_t> positions_;
  std::vector<std::size_t> due_;  // indices of timers
};

}  // namespace rclcpp
