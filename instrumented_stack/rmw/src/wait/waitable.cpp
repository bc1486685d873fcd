// SPDX-License-Identifier: Apache-2.0
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

std::mutex& attachments() {
  static std::mutex mutex;
  return mutex;
}

Waitable::~Waitable() {
  const std::lock_guard lock(attachments());
  for (const auto& [waiter, position] : attached_to_) {
    waiter->attached_[position] = nullptr;
    waiter->is_stale_.store(true, std::memory_order_release);
  }
}

void Waitable::attach(Waiter& waiter, std::size_t position) {
  const std::lock_guard lock(mutex_);
  attached_to_.push_back({&waiter, position});
}

void Waitable::detach(const Waiter& waiter, std::size_t position) {
  const std::lock_guard lock(mutex_);
  std::erase_if(attached_to_, [&](const Attachment& attachment) {
    return attachment.waiter == &waiter && attachment.position == position;
  });
}

[[gnu::hot]] void Waitable::notify() {
  const std::lock_guard lock(mutex_);
  for (const auto& [waiter, position] : attached_to_) {
    waiter->wake(position);
  }
}

void GuardCondition::trigger() {
  triggered_.store(true, std::memory_order_release);
  notify();
}

}  // namespace rmw_fastrtps
