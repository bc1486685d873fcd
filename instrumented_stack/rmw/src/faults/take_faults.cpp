// SPDX-License-Identifier: Apache-2.0
#include "faults/take_faults.hpp"

#include <new>
#include <utility>

#include "faults/delayed_calls.hpp"
#include "types/message_type.hpp"

namespace rmw_fastrtps {

template <typename Info>
TakeFaults<Info>::TakeFaults(std::unique_ptr<MessageFaults> faults, const message_type_support_callbacks_t& type,
                             std::function<void()> announce)
    : faults_(std::move(faults)), type_(type), announce_(std::move(announce)) {
  buffer_ = rmw_get_zero_initialized_serialized_message();
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  if (rmw_serialized_message_init(&buffer_, 0, &allocator) != RCUTILS_RET_OK) {
    throw std::bad_alloc();
  }
}

template <typename Info>
TakeFaults<Info>::~TakeFaults() {
  delayed_calls().forget(this);
  (void)rmw_serialized_message_fini(&buffer_);
}

template <typename Info>
bool TakeFaults<Info>::take(const Reader& reader, const IncomingMessage& message, Info& info) {
  std::unique_lock lock(mutex_);
  while (true) {
    Message next;
    std::size_t copies = 0;
    if (!waiting_.empty()) {
      next = std::move(waiting_.front());
      waiting_.pop_front();
    } else {
      if (!reader(buffer_, next.info)) {
        return false;
      }
      next.bytes.assign(buffer_.buffer, buffer_.buffer + buffer_.buffer_length);
      if (!pass(next, copies)) {
        continue;
      }
    }
    if (from_bytes(type_, next.bytes, message)) {
      info = next.info;
      waiting_.insert(waiting_.end(), copies, next);
      lock.unlock();
      for (; copies > 0; --copies) {
        announce_();
      }
      return true;
    }
  }
}

template <typename Info>
bool TakeFaults<Info>::pass(Message& message, std::size_t& copies) {
  const MessageFate fate = faults_->next();
  if (fate.is_dropped) {
    return false;
  }
  for (const std::uint64_t seed : fate.corruptions) {
    corrupt(message.bytes.data(), message.bytes.size(), seed);
  }
  if (fate.delay.count() == 0) {
    copies = fate.copies - 1;
    return true;
  }
  const auto due = DelayedCalls::Clock::now() + fate.delay;
  for (unsigned copy = 0; copy < fate.copies; ++copy) {
    delayed_calls().add(this, due, [this, message] { put(message); });
  }
  return false;
}

template <typename Info>
void TakeFaults<Info>::put(const Message& message) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(message);
  }
  announce_();
}

template <typename Info>
bool TakeFaults<Info>::has_message() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

template class TakeFaults<rmw_message_info_t>;
template class TakeFaults<rmw_service_info_t>;

}  // namespace rmw_fastrtps
