// SPDX-License-Identifier: Apache-2.0
// What a Waiter waits for. A waitable and the waiters that it is attached to stay known to each other between waits, so
// that a wait for the same entities as before locks none of them.
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "rmw/waiter.hpp"

namespace rmw_fastrtps {

// The lock under which waiters and waitables get to know each other: one for the whole process, so that either side can
// be destroyed first.
std::mutex& attachments();

// Something that becomes ready. `data` of subscriptions, services, clients, events and guard conditions points at one.
class Waitable {
 public:
  Waitable() = default;
  Waitable(const Waitable&) = delete;
  Waitable& operator=(const Waitable&) = delete;
  virtual ~Waitable();

  // Called by the thread that waits. Whatever is ready once per trigger is reset by this.
  virtual bool is_ready() = 0;

 protected:
  // Wakes the waiters. Any thread.
  void notify();

 private:
  friend class Waiter;
  struct Attachment {
    Waiter* waiter;
    std::size_t position;
  };

  // Both under the lock of attachments. After detach(), `waiter` is not touched any more for this position.
  void attach(Waiter& waiter, std::size_t position);
  void detach(const Waiter& waiter, std::size_t position);

  std::mutex mutex_;
  std::vector<Attachment> attached_to_;
};

class GuardCondition final : public Waitable {
 public:
  void trigger();
  // True once per trigger, or series of triggers.
  bool is_ready() override {
    return triggered_.load(std::memory_order_acquire) && triggered_.exchange(false, std::memory_order_acq_rel);
  }

 private:
  std::atomic<bool> triggered_{false};
};

}  // namespace rmw_fastrtps
