#include "waitable.hpp"

#include <algorithm>
#include <utility>

namespace rmw_fastrtps {

void Waiter::reset() {
  std::lock_guard lock(mutex_);
  woken_ = false;
}

void Waiter::wake() {
  {
    std::lock_guard lock(mutex_);
    if (woken_) {
      return;
    }
    woken_ = true;
  }
  condition_.notify_one();
}

bool Waiter::wait_until(std::optional<TimePoint> deadline) {
  std::unique_lock lock(mutex_);
  if (deadline) {
    condition_.wait_until(lock, *deadline, [this] { return woken_; });
  } else {
    condition_.wait(lock, [this] { return woken_; });
  }
  return std::exchange(woken_, false);
}

void Waitable::attach(Waiter& waiter) {
  std::lock_guard lock(mutex_);
  waiters_.push_back(&waiter);
}

void Waitable::detach(Waiter& waiter) {
  std::lock_guard lock(mutex_);
  waiters_.erase(std::remove(waiters_.begin(), waiters_.end(), &waiter), waiters_.end());
}

void Waitable::notify() {
  std::lock_guard lock(mutex_);
  for (Waiter* waiter : waiters_) {
    waiter->wake();
  }
}

void GuardCondition::trigger() {
  triggered_.store(true, std::memory_order_release);
  notify();
}

}  // namespace rmw_fastrtps
