// SPDX-License-Identifier: Apache-2.0
// The waitables of an executor in one wait. Each waitable adds its rcl entities before the wait. After the wait it
// tells whether these entities make it ready.
//
// For each wait call ask(), wait, then call append_ready(). Call release() in any case.
#pragma once

#include <rcl/wait.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <rmw/waiter.hpp>
#include <vector>

#include "executor/timer_queue.hpp"
#include "executor/waited_entities.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

// For one thread at a time. The functions throw if rcl reports an error, and pass on exceptions of waitables.
class AskedWaitables {
 public:
  explicit AskedWaitables(const std::shared_ptr<rcl_context_t>& context);
  ~AskedWaitables();
  RCLCPP_DISABLE_COPY(AskedWaitables)

  // Asks the waitables for their entities, except the waitables of groups of which nothing may be taken. Registers the
  // entities with `waiter` from position `first` on. Earlier registrations from `first` on are removed.
  void ask(const WaitedEntities& waited, rmw_fastrtps::Waiter& waiter, std::size_t first);

  // Nanoseconds until the first timer of the waitables is due. TimerQueue::kNever if they have no timer.
  std::int64_t time_until_first_timer() const;

  // Appends the waitables that are ready. `next` and `end` enclose the positions that the wait has found ready, counted
  // as in the waiter, from the `first` of ask() on.
  void append_ready(const WaitedEntities& waited, const std::size_t* next, const std::size_t* end,
                    std::vector<detail::ReadyEntity>& ready);

  // Releases the waitables. This object may be their last owner.
  void release() { held_.clear(); }

 private:
  // How many entities of each kind the wait set has room for.
  struct Sizes {
    std::size_t timers = 0;
    std::size_t subscriptions = 0;
    std::size_t services = 0;
    std::size_t clients = 0;
    std::size_t events = 0;
    std::size_t guard_conditions = 0;
    bool operator==(const Sizes&) const = default;
  };
  struct Held {
    Waitable::SharedPtr waitable;
    std::size_t group;
  };

  void fill_wait_set(const Sizes& sizes);

  const std::shared_ptr<rcl_context_t> context_;
  rcl_wait_set_t wait_set_;
  Sizes sizes_;
  std::vector<Held> held_;
  std::vector<void*> rmw_entities_;
  std::size_t first_ = 0;
};

}  // namespace rclcpp
