// SPDX-License-Identifier: Apache-2.0
// The waitables of an executor in one wait. Each waitable adds its rcl entities before the wait. After the wait it
// tells whether these entities make it ready.
//
// For each wait call ask(), wait, then call append_ready(). Call release() in any case. A waitable of a busy group
// stays registered as it was, so that the end of each callback costs no new registration. The wait does not touch such
// a waitable, because its callback may destroy the registered entities.
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <rmw/waiter.hpp>
#include <variant>
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

  // Call it after the registrations were removed from the waiter, and before ask() gets another `waited`.
  void forget_registrations() { registrations_.clear(); }

  // Asks the waitables for their entities, except the waitables of groups of which nothing may be taken. Registers the
  // entities with `waiter` from position `first` on, unless exactly these entities are registered there.
  void ask(const WaitedEntities& waited, rmw_fastrtps::Waiter& waiter, std::size_t first);

  // Nanoseconds until the first timer of the waitables is due. TimerQueue::kNever if they have no timer.
  std::int64_t time_until_first_timer() const;

  // Appends the waitables that are ready. `begin` and `end` enclose the positions that the wait has found ready,
  // counted as in the waiter, from the `first` of ask() on. When a waitable throws, the others are asked nevertheless,
  // since their triggers are used up. The first exception is thrown at the end.
  void append_ready(const WaitedEntities& waited, const std::size_t* begin, const std::size_t* end,
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
    std::size_t index;  // in WaitedEntities::waitables
  };
  struct Registration {
    void* rmw_entity;
    std::size_t waitable;  // its index
    bool operator==(const Registration&) const = default;
  };
  // A place in the wait set.
  using Entry = std::variant<const rcl_subscription_t**, const rcl_service_t**, const rcl_client_t**,
                             const rcl_event_t**, const rcl_guard_condition_t**, const rcl_timer_t**>;

  void hold(const WaitedEntities& waited);
  void fill_wait_set(const Sizes& sizes);
  // Lists what a waitable has added. `next` is the first entry of each kind behind those that are listed.
  void list_entries(std::size_t waitable, Sizes& next);
  // Finds the positions of the entries. False if they are not what is registered, apart from waitables that are not
  // held.
  bool find_positions(const rmw_fastrtps::Waiter& waiter);

  const std::shared_ptr<rcl_context_t> context_;
  rcl_wait_set_t wait_set_;
  Sizes sizes_;
  std::vector<Held> held_;
  // By waitable: whether it is held in this wait. What is not held must not be touched, even if its group becomes free.
  std::vector<std::atomic_bool> is_held_;
  std::vector<Registration> registrations_;  // from position first_ on
  std::size_t first_ = 0;
  // What the wait set has, waitable after waitable; what is to be registered for it, and the positions of that.
  std::vector<Entry> entries_;
  std::vector<Registration> wanted_;
  std::vector<std::size_t> positions_;
};

}  // namespace rclcpp
