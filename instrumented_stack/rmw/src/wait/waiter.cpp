// SPDX-License-Identifier: Apache-2.0
#include "rmw/waiter.hpp"

#include <algorithm>
#include <utility>

#include "wait/waitable.hpp"

namespace rmw_fastrtps {
namespace {

// No deadline is computed for a longer wait.
constexpr std::chrono::nanoseconds kForever = std::chrono::hours(24 * 365 * 30);

}  // namespace

Waiter::~Waiter() {
  remove_from(0);
}

void Waiter::add(void* entity, const std::atomic_bool* may_be_taken) {
  const std::size_t position = registrations_.size();
  registrations_.push_back({static_cast<Waitable*>(entity), may_be_taken});
  to_ask_.resize(registrations_.size());
  to_ask_.add(position);
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
  to_ask_.resize(first);
  const std::lock_guard lock(mutex_);
  woken_by_.resize(std::min(first, woken_by_.is_listed.size()));
}

bool Waiter::has_from(std::size_t first, const std::vector<void*>& entities) const {
  return !is_stale_.load(std::memory_order_acquire) && registrations_.size() == first + entities.size() &&
         std::equal(entities.begin(), entities.end(), registrations_.begin() + static_cast<std::ptrdiff_t>(first),
                    [](const void* entity, const Registration& known) { return entity == known.waitable; });
}

bool Waiter::has_only_living() const {
  return attached_.size() == registrations_.size() && !is_stale_.load(std::memory_order_acquire);
}

[[gnu::hot]] void Waiter::wait(std::chrono::nanoseconds timeout, std::vector<std::size_t>& ready) {
  ready.clear();
  const bool may_block = timeout != std::chrono::nanoseconds::zero();
  if (attached_.size() < registrations_.size()) {
    if (!may_block && !std::exchange(has_polled_, true)) {
      for (std::size_t i = 0; i < registrations_.size(); ++i) {
        if (ask(i, ready)) {
          to_ask_.add(i);
        }
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
  {
    const std::lock_guard lock(mutex_);
    woken_by_.resize(registrations_.size());
  }
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
  for (const std::size_t position : woken_by_.positions) {
    to_ask_.add(position);
  }
  woken_by_.clear();
}

// Not under the lock: DDS calls wake() under locks of its own, which is_ready() takes too.
[[gnu::hot]] void Waiter::ask_candidates(std::vector<std::size_t>& ready) {
  std::vector<std::size_t>& positions = to_ask_.positions;
  std::size_t kept = 0;
  for (const std::size_t position : positions) {
    if (ask(position, ready)) {
      positions[kept++] = position;
    } else {
      to_ask_.is_listed[position] = false;
    }
  }
  positions.resize(kept);
  if (ready.size() > 1) {
    std::sort(ready.begin(), ready.end());
  }
}

[[gnu::hot]] bool Waiter::ask(std::size_t position, std::vector<std::size_t>& ready) {
  const auto& [waitable, may_be_taken] = registrations_[position];
  // Sequentially consistent, as the change to true is: whoever changes it looks afterwards for somebody to wake.
  if (may_be_taken != nullptr && !may_be_taken->load()) {
    return true;
  }
  if (!waitable->is_ready()) {
    return false;
  }
  ready.push_back(position);
  return true;  // an entity that is still ready does not call wake() again
}

void Waiter::Candidates::resize(std::size_t size) {
  if (size < is_listed.size()) {
    std::erase_if(positions, [size](std::size_t position) { return position >= size; });
  }
  is_listed.resize(size);
  // wake() must not allocate. At least twice as much each time: entities are registered one by one.
  if (positions.capacity() < size) {
    positions.reserve(std::max(size, 2 * positions.capacity()));
  }
}

[[gnu::hot]] void Waiter::Candidates::add(std::size_t position) {
  if (!is_listed[position]) {
    is_listed[position] = true;
    positions.push_back(position);
  }
}

[[gnu::hot]] void Waiter::Candidates::clear() {
  for (const std::size_t position : positions) {
    is_listed[position] = false;
  }
  positions.clear();
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
