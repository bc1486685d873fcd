// SPDX-License-Identifier: Apache-2.0
// What rmw_wait() sleeps on: a Waiter per wait set, known to every Waitable that the wait set waits for.
//
// They stay known to each other between waits, so that a wait for the same entities as before locks none of them. A
// message costs one lock and one wake-up of the thread that waits for it, however many other entities that thread waits
// for; and since it says whose message it is, the idle ones are not even looked at.
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

// Where one thread sleeps.
class Waiter {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  Waiter() = default;
  ~Waiter();
  Waiter(const Waiter&) = delete;
  Waiter& operator=(const Waiter&) = delete;

  // From now on these wake the waiter. If they are some of those of the last call, in the same order, the others go on
  // waking it too: what an executor leaves out for the moment costs no lock, only a look more when it wakes. They may
  // be destroyed at any time before the next call, but not while the waiter sleeps.
  void watch(const std::vector<Waitable*>& waitables);

  // Whether watch() would change nothing.
  bool watches(const std::vector<Waitable*>& waitables) const;

  // Appends the indices of those of `waitables`, which must be watched, that are ready, in their order. Asks only those
  // that have called wake() since they were last found not to be ready. Forgets earlier wake-ups.
  void find_ready(const std::vector<Waitable*>& waitables, std::vector<std::size_t>& ready);

  // Sleeps until wake() was called since the last find_ready() or wait_ready(), then does what find_ready() does: true,
  // even if nothing was ready. False at the deadline. No deadline: forever.
  bool wait_ready(std::optional<TimePoint> deadline, const std::vector<Waitable*>& waitables,
                  std::vector<std::size_t>& ready);

  // `waitable` may be ready now. Any thread.
  void wake(Waitable& waitable);

 private:
  friend class Waitable;

  // With the mutex held: what has called wake() is to be asked.
  void receive_candidates();
  void ask(const std::vector<Waitable*>& waitables, std::vector<std::size_t>& ready);

  // The arguments of the last watch() that changed something, to be compared only. Of the waiting thread.
  std::vector<Waitable*> wanted_;
  std::atomic<bool> stale_{false};  // one of them was destroyed: its address may be another's now
  std::vector<Waitable*> watched_;  // those of them that live; under the lock of attachments

  // Waitables that may be ready, if they are few; they may be gone, too, and are only compared.
  struct Candidates {
    void add(Waitable* waitable);

    std::vector<Waitable*> few;
    bool all = false;
  };
  Candidates to_ask_;  // next time, of the waiting thread
  std::vector<Waitable*> asked_;

  std::mutex mutex_;
  std::condition_variable condition_;
  bool woken_ = false;
  Candidates woken_by_;
};

// Something that becomes ready. `data` of subscriptions, services, clients and guard conditions points at one.
class Waitable {
 public:
  Waitable() = default;
  Waitable(const Waitable&) = delete;
  Waitable& operator=(const Waitable&) = delete;
  virtual ~Waitable();

  virtual bool is_ready() = 0;

 protected:
  // Wakes whoever waits. Any thread.
  void notify();

 private:
  friend class Waiter;

  void attach(Waiter& waiter);
  // After this, `waiter` is not touched any more.
  void detach(Waiter& waiter);

  std::mutex mutex_;
  std::vector<Waiter*> waiters_;
};

class GuardCondition final : public Waitable {
 public:
  void trigger();
  bool is_ready() override { return triggered_.load(std::memory_order_acquire); }
  // True once per trigger, or series of them.
  bool consume() { return triggered_.exchange(false, std::memory_order_acq_rel); }

 private:
  std::atomic<bool> triggered_{false};
};

}  // namespace rmw_fastrtps
