// SPDX-License-Identifier: Apache-2.0
#include "rmw/waiter.hpp"

#include <algorithm>
#include <utility>

#include "wait/waitable.hpp"

namespace rmw_fastrtps {
namespace {

// More candidates are not listed one by one.
constexpr std::size_t kManyCandidates = 16;

// No deadline is computed for a longer wait.
constexpr std::chrono::nanoseconds kForever = std::chrono::hours(24 * 365 * 30);

}  // namespace

Waiter::~Waiter() {
  remove_from(0);
}

void Waiter::add(void* entity, const std::atomic_bool* may_be_taken) {
  to_ask_.add(registrations_.size());
  registrations_.push_back({static_cast<Waitable*>(entity), may_be_taken});
}

void Waiter::remove_from(std::size_t first) {
  if (first >= registrations_.size()) {
    return;
  }
  if (first < attached_.size()) {
    const std::lock_guard lock(attachments());
    for (std::size_t i = first; i < attached_.size(); ++i) {
      if (attached_[i] != nullptr) {
        attached_[i]->detach(*this, i);
      }
    }
    attached_.resize(first);
    const bool is_stale = std::find(attached_.begin(), attached_.end(), nullptr) != attached_.end();
    is_stale_.store(is_stale, std::memory_order_release);
  }
  registrations_.resize(first);
  has_polled_ = has_polled_ && first > 0;
  to_ask_.remove_from(first);
  const std::lock_guard lock(mutex_);
  woken_by_.remove_from(first);
}

bool Waiter::has_from(std::size_t first, const std::vector<void*>& entities) const {
  return !is_stale_.load(std::memory_order_acquire) && registrations_.size() == first + entities.size() &&
         std::equal(entities.begin(), entities.end(), registrations_.begin() + static_cast<std::ptrdiff_t>(first),
                    [](const void* entity, const Registration& known) { return entity == known.waitable; });
}

[[gnu::hot]] void Waiter::wait(std::chrono::nanoseconds timeout, std::vector<std::size_t>& ready) {
  ready.clear();
  const bool may_block = timeout != std::chrono::nanoseconds::zero();
  if (attached_.size() < registrations_.size()) {
    if (!may_block && !std::exchange(has_polled_, true)) {
      for (std::size_t i = 0; i < registrations_.size(); ++i) {
        ask(i, ready);
      }
      return;
    }
    attach();
  }
  Deadline deadline;
  if (may_block && timeout > std::chrono::nanoseconds::zero() && timeout < kForever) {
    deadline = std::chrono::steady_clock::now() + timeout;
  }
  {
    const std::lock_guard lock(mutex_);
    receive_candidates();
  }
  ask_candidates(ready);
  // A wake-up can be for data that another thread has taken meanwhile: then sleep on.
  while (may_block && ready.empty() && sleep(deadline)) {
    ask_candidates(ready);
  }
}

void Waiter::attach() {
  const std::lock_guard lock(attachments());
  for (std::size_t i = attached_.size(); i < registrations_.size(); ++i) {
    attached_.push_back(registrations_[i].waitable);
    registrations_[i].waitable->attach(*this, i);
  }
}

// False at the deadline.
[[gnu::hot]] bool Waiter::sleep(const Deadline& deadline) {
  std::unique_lock lock(mutex_);
  if (!deadline) {
    condition_.wait(lock, [this] { return woken_; });
  } else if (!condition_.wait_until(lock, *deadline, [this] { return woken_; })) {
    return false;
  }
  receive_candidates();
  return true;
}

void Waiter::receive_candidates() {
  woken_ = false;
  for (const std::size_t position : woken_by_.few) {
    to_ask_.add(position);
  }
  woken_by_.few.clear();
  to_ask_.all = std::exchange(woken_by_.all, false) || to_ask_.all;
}

// Not under the lock: DDS calls wake() under locks of its own, which is_ready() takes too.
[[gnu::hot]] void Waiter::ask_candidates(std::vector<std::size_t>& ready) {
  asked_.swap(to_ask_.few);
  to_ask_.few.clear();
  if (std::exchange(to_ask_.all, false)) {
    for (std::size_t i = 0; i < registrations_.size(); ++i) {
      ask(i, ready);
    }
    return;
  }
  for (const std::size_t position : asked_) {
    ask(position, ready);
  }
  if (ready.size() > 1) {
    std::sort(ready.begin(), ready.end());
  }
}

[[gnu::hot]] void Waiter::ask(std::size_t position, std::vector<std::size_t>& ready) {
  const auto& [waitable, may_be_taken] = registrations_[position];
  if (may_be_taken != nullptr && !may_be_taken->load(std::memory_order_acquire)) {
    to_ask_.add(position);
  } else if (waitable->is_ready()) {
    ready.push_back(position);
    to_ask_.add(position);  // an entity that is still ready does not call wake() again
  }
}

[[gnu::hot]] void Waiter::Candidates::add(std::size_t position) {
  if (all || std::find(few.begin(), few.end(), position) != few.end()) {
    return;
  }
  if (few.size() == kManyCandidates) {
    few.clear();
    all = true;
  } else {
    few.push_back(position);
  }
}

void Waiter::Candidates::remove_from(std::size_t first) {
  std::erase_if(few, [first](std::size_t position) { return position >= first; });
  all = all && first > 0;
}

[[gnu::hot]] void Waiter::wake(std::size_t position) {
  {
    const std::lock_guard lock(mutex_);
    woken_by_.add(position);
    if (woken_) {
      return;
    }
    woken_ = true;
  }
  condition_.notify_one();
}

}  // namespace rmw_fastrtps
