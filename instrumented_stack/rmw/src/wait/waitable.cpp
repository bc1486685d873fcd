// SPDX-License-Identifier: Apache-2.0
#include "wait/waitable.hpp"

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
  to_ask_.few.clear();
  to_ask_.all = true;
  // What was destroyed is among no waitables any more, and would be looked for again and again.
  const std::lock_guard candidates_lock(mutex_);
  woken_by_.few.clear();
}

bool Waiter::watches(const std::vector<Waitable*>& waitables) const {
  if (stale_.load(std::memory_order_acquire)) {
    return false;
  }
  return waitables == wanted_ || is_subsequence(waitables, wanted_);
}

[[gnu::hot]] void Waiter::find_ready(const std::vector<Waitable*>& waitables, std::vector<std::size_t>& ready) {
  {
    const std::lock_guard lock(mutex_);
    receive_candidates();
  }
  ask(waitables, ready);
}

[[gnu::hot]] bool Waiter::wait_ready(std::optional<TimePoint> deadline, const std::vector<Waitable*>& waitables,
                                     std::vector<std::size_t>& ready) {
  {
    std::unique_lock lock(mutex_);
    if (!deadline) {
      condition_.wait(lock, [this] { return woken_; });
    } else if (!condition_.wait_until(lock, *deadline, [this] { return woken_; })) {
      return false;
    }
    receive_candidates();
  }
  ask(waitables, ready);
  return true;
}

void Waiter::receive_candidates() {
  woken_ = false;
  for (Waitable* waitable : woken_by_.few) {
    to_ask_.add(waitable);
  }
  woken_by_.few.clear();
  to_ask_.all = std::exchange(woken_by_.all, false) || to_ask_.all;
}

// Not under the lock: DDS calls wake() under locks of its own, which is_ready() takes too.
[[gnu::hot]] void Waiter::ask(const std::vector<Waitable*>& waitables, std::vector<std::size_t>& ready) {
  asked_.swap(to_ask_.few);
  to_ask_.few.clear();
  const std::size_t before = ready.size();
  if (std::exchange(to_ask_.all, false)) {
    for (std::size_t i = 0; i < waitables.size(); ++i) {
      if (waitables[i]->is_ready()) {
        ready.push_back(i);
        to_ask_.add(waitables[i]);
      }
    }
    to_ask_.all = to_ask_.all || waitables.size() < wanted_.size();
    return;
  }
  // A few are looked for among perhaps thousands, of which nothing but the addresses is read.
  for (Waitable* waitable : asked_) {
    const auto found = std::find(waitables.begin(), waitables.end(), waitable);
    if (found == waitables.end()) {
      to_ask_.add(waitable);
    } else if (waitable->is_ready()) {
      ready.push_back(static_cast<std::size_t>(found - waitables.begin()));
      to_ask_.add(waitable);  // who is ready does not say so again
    }
  }
  if (ready.size() > before + 1) {
    std::sort(ready.begin() + static_cast<std::ptrdiff_t>(before), ready.end());
  }
}

[[gnu::hot]] void Waiter::Candidates::add(Waitable* waitable) {
  if (all || contains(few, waitable)) {
    return;
  }
  if (few.size() == kManyCandidates) {
    few.clear();
    all = true;
  } else {
    few.push_back(waitable);
  }
}

[[gnu::hot]] void Waiter::wake(Waitable& waitable) {
  {
    const std::lock_guard lock(mutex_);
    woken_by_.add(&waitable);
    if (woken_) {
      return;
    }
    woken_ = true;
  }
  condition_.notify_one();
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

[[gnu::hot]] void Waitable::notify() {
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
