// SPDX-License-Identifier: Apache-2.0
// The wait of one thread for any number of entities: the one list of what is registered, and the answer which of it is
// ready. rmw_wait() stands on it. An executor, which waits for the same entities again and again, uses it directly.
//
// Register entities with add(), then call wait() as often as you like. A registered entity tells the waiter by itself
// when something arrives, so idle entities are not polled, and a message costs one lock and one wake-up of the waiting
// thread, however many entities are registered.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace rmw_fastrtps {

class Waitable;

// For one thread at a time, except for wake().
class Waiter {
 public:
  Waiter() = default;
  ~Waiter();
  Waiter(const Waiter&) = delete;
  Waiter& operator=(const Waiter&) = delete;

  // Registers an entity: `data` of an rmw subscription, service, client, event or guard condition. It gets the next
  // position, counted from 0. While `*may_be_taken` is false the entity is not asked, and what arrives for it ends no
  // wait; after a change to true, another entity must end the wait. Null: the entity is always asked.
  //
  // An entity may be destroyed between waits. Its registration must be removed before the next wait.
  void add(void* entity, const std::atomic_bool* may_be_taken = nullptr);
  // Removes the registrations from position `first` on.
  void remove_from(std::size_t first);
  // Whether exactly these living entities are registered from position `first` on.
  bool has_from(std::size_t first, const std::vector<void*>& entities) const;

  // Waits until an entity is ready or the time is over; 0 does not block, a negative time is no limit. `ready` gets the
  // positions of all entities that are ready, in ascending order. Ready guard conditions are reset.
  //
  // The first wait that does not block asks each entity. Only further waits make the entities tell the waiter.
  void wait(std::chrono::nanoseconds timeout, std::vector<std::size_t>& ready);

  // The entity at the position may be ready now. Any thread.
  void wake(std::size_t position);

 private:
  friend class Waitable;
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  struct Registration {
    Waitable* waitable;
    const std::atomic_bool* may_be_taken;
  };
  // Positions of entities that may be ready, as long as they are few.
  struct Candidates {
    void add(std::size_t position);
    void remove_from(std::size_t first);

    std::vector<std::size_t> few;
    bool all = false;
  };

  void attach();
  bool sleep(const Deadline& deadline);
  // With the mutex held: what has called wake() is to be asked.
  void receive_candidates();
  void ask_candidates(std::vector<std::size_t>& ready);
  void ask(std::size_t position, std::vector<std::size_t>& ready);

  std::vector<Registration> registrations_;
  bool has_polled_ = false;  // what is registered, at least once
  Candidates to_ask_;        // in the next wait
  std::vector<std::size_t> asked_;

  // The first registered entities, which call wake(). Null: the entity was destroyed. Under the lock of attachments.
  std::vector<Waitable*> attached_;
  std::atomic<bool> is_stale_{false};  // one of them was destroyed: its address may be another entity's now

  std::mutex mutex_;
  std::condition_variable condition_;
  bool woken_ = false;
  Candidates woken_by_;
};

}  // namespace rmw_fastrtps
