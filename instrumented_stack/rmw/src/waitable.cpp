#include "waitable.hpp"

#include <algorithm>
#include <utility>

namespace rmw_fastrtps {
namespace {

// Who watches whom, in the whole process, changes under this lock, so that either side can go first.
std::mutex& attachments() {
  static std::mutex mutex;
  return mutex;
}

bool is_subsequence(const std::vector<Waitable*>& part, const std::vector<Waitable*>& whole) {
  auto next = part.begin();
  for (auto it = whole.begin(); it != whole.end() && next != part.end(); ++it) {
    if (*it == *next) {
      ++next;
    }
  }
  return next == part.end();
}

}  // namespace

Waiter::~Waiter() {
  std::lock_guard lock(attachments());
  for (Waitable* waitable : watched_) {
    waitable->detach(*this);
  }
}

void Waiter::watch(const std::vector<Waitable*>& waitables) {
  if (!stale_.load(std::memory_order_acquire) && is_subsequence(waitables, wanted_)) {
    return;
  }
  std::lock_guard lock(attachments());
  for (Waitable* waitable : watched_) {
    waitable->detach(*this);
  }
  for (Waitable* waitable : waitables) {
    waitable->attach(*this);
  }
  watched_ = waitables;
  wanted_ = waitables;
  stale_ = false;
}

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

Waitable::~Waitable() {
  std::lock_guard lock(attachments());
  for (Waiter* waiter : waiters_) {
    std::erase(waiter->watched_, this);
    waiter->stale_.store(true, std::memory_order_release);
  }
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
