// SPDX-License-Identifier: Apache-2.0
// Lets one thread wait for any number of entities. rmw_wait() uses it. An executor waits for the same entities again
// and again, and uses it directly.
//
// Register entities with add(), then call wait() as often as you like. A registered entity tells the waiter when
// something arrives, so idle entities are not polled. A message costs one lock and one wake-up of the waiting thread,
// however many entities are registered.
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

  // Registers an entity: `data` of an rmw subscription, service, client, event or guard condition. The entity gets the
  // next position, counted from 0.
  //
  // While `*may_be_taken` is false, the entity is not asked, and its data end no wait. When the flag becomes true,
  // another entity must end the wait that is going on. If the pointer is null, the entity is always asked.
  //
  // An entity may be destroyed between waits. Its registration must be removed before the next wait.
  void add(void* entity, const std::atomic_bool* may_be_taken = nullptr);
  // Removes the registrations from position `first` on.
  void remove_from(std::size_t first);
  // Whether exactly these living entities are registered from position `first` on.
  bool has_from(std::size_t first, const std::vector<void*>& entities) const;
  // Whether it is sure that every registered entity lives: one that was not waited for yet can have gone unnoticed.
  bool has_only_living() const;

  // Waits until an entity is ready or the timeout is over. A timeout of 0 does not block, a negative one never ends.
  // `ready` gets the positions of all entities that are ready, in ascending order. Ready guard conditions are reset.
  //
  // The first wait asks each entity. If it does not block, the entities do not learn of the waiter yet: a single poll
  // is cheaper that way.
  void wait(std::chrono::nanoseconds timeout, std::vector<std::size_t>& ready);

  // Tells that the entity at the position may be ready now. Any thread may call it.
  void wake(std::size_t position);

 private:
  friend class Waitable;
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  struct Registration {
    Waitable* waitable;
    const std::atomic_bool* may_be_taken;
  };
  // The positions of the entities that may be ready. Each is listed once.
  struct Candidates {
    // For the positions below `size`.
    void resize(std::size_t size);
    void add(std::size_t position);
    void clear();

    std::vector<std::size_t> positions;
    std::vector<bool> is_listed;  // by position
  };

  void attach();
  bool sleep(const Deadline& deadline);
  // Adds the positions that wake() has collected to `to_ask_`. The mutex must be held.
  void receive_candidates();
  void ask_candidates(std::vector<std::size_t>& ready);
  // Whether the entity is to be asked again in the next wait.
  bool ask(std::size_t position, std::vector<std::size_t>& ready);

  std::vector<Registration> registrations_;
  bool has_polled_ = false;  // a wait that did not block has asked all entities
  Candidates to_ask_;        // the entities to ask in the next wait

  // The first registered entities, which call wake(). An entity that was destroyed is null here. The lock of
  // attachments guards the list.
  std::vector<Waitable*> attached_;
  // An attached entity was destroyed. A new entity may have its address now.
  std::atomic<bool> is_stale_{false};

  std::mutex mutex_;
  std::condition_variable condition_;
  bool woken_ = false;
  Candidates woken_by_;  // has room for all that are attached
};

}  // namespace rmw_fastrtps
