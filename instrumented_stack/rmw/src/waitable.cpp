#include "waitable.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rmw_fastrtps {
namespace {

// Who watches whom, in the whole process, changes under this lock, so that either side can go first.
std::mutex& attachments() {
  static std::mutex mutex;
  return mutex;
}

// More are not looked for one by one.
constexpr std::size_t kManyCandidates = 16;

bool contains(const std::vector<Waitable*>& waitables, const Waitable* waitable) {
  return std::find(waitables.begin(), waitables.end(), waitable) != waitables.end();
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
  if (watches(waitables)) {
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
  std::lock_guard candidates_lock(mutex_);
  candidates_.clear();
  all_are_candidates_ = true;
}

bool Waiter::watches(const std::vector<Waitable*>& waitables) const {
  if (stale_.load(std::memory_order_acquire)) {
    return false;
  }
  return waitables == wanted_ || is_subsequence(waitables, wanted_);
}

void Waiter::find_ready(const std::vector<Waitable*>& waitables, std::vector<std::size_t>& ready) {
  asked_.clear();
  bool all = false;
  {
    std::lock_guard lock(mutex_);
    woken_ = false;
    asked_.swap(candidates_);
    all = std::exchange(all_are_candidates_, false);
  }
  // Not under the lock: DDS calls wake() under locks of its own, which is_ready() takes too.
  const std::size_t before = ready.size();
  if (all) {
    asked_.clear();
    for (std::size_t i = 0; i < waitables.size(); ++i) {
      if (waitables[i]->is_ready()) {
        ready.push_back(i);
      }
    }
  } else {
    // A few are looked for among perhaps thousands, of which nothing but the addresses is read.
    asked_at_.clear();
    std::erase_if(asked_, [&](Waitable* waitable) {
      const auto found = std::find(waitables.begin(), waitables.end(), waitable);
      if (found != waitables.end()) {
        asked_at_.push_back(static_cast<std::size_t>(found - waitables.begin()));
      }
      return found != waitables.end();
    });
    std::sort(asked_at_.begin(), asked_at_.end());
    std::copy_if(asked_at_.begin(), asked_at_.end(), std::back_inserter(ready),
                 [&](std::size_t i) { return waitables[i]->is_ready(); });
  }
  // Who is ready does not say so again. Who was not asked may be ready.
  std::lock_guard lock(mutex_);
  for (std::size_t i = before; i < ready.size(); ++i) {
    add_candidate(waitables[ready[i]]);
  }
  for (Waitable* waitable : asked_) {
    add_candidate(waitable);
  }
  if (all && waitables.size() < wanted_.size()) {
    all_are_candidates_ = true;
  }
}

void Waiter::add_candidate(Waitable* waitable) {
  if (all_are_candidates_ || contains(candidates_, waitable)) {
    return;
  }
  if (candidates_.size() == kManyCandidates) {
    candidates_.clear();
    all_are_candidates_ = true;
  } else {
    candidates_.push_back(waitable);
  }
}

void Waiter::wake(Waitable& waitable) {
  {
    std::lock_guard lock(mutex_);
    add_candidate(&waitable);
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
    waiter->wake(*this);
  }
}

void GuardCondition::trigger() {
  triggered_.store(true, std::memory_order_release);
  notify();
}

}  // namespace rmw_fastrtps
