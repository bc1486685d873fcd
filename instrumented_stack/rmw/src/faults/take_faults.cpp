// SPDX-License-Identifier: Apache-2.0
#include "faults/take_faults.hpp"

#include <new>
#include <utility>

#include "faults/delayed_calls.hpp"
#include "types/message_type.hpp"

namespace rmw_fastrtps {

TakeFaults::TakeFaults(std::unique_ptr<MessageFaults> faults, const message_type_support_callbacks_t& type,
                       std::function<void()> announce)
    : faults_(std::move(faults)), type_(type), announce_(std::move(announce)) {
  buffer_ = rmw_get_zero_initialized_serialized_message();
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  if (rmw_serialized_message_init(&buffer_, 0, &allocator) != RCUTILS_RET_OK) {
    throw std::bad_alloc();
  }
}

TakeFaults::~TakeFaults() {
  delayed_calls().forget(this);
  (void)rmw_serialized_message_fini(&buffer_);
}

bool TakeFaults::take(const Reader& reader, const IncomingMessage& message, rmw_message_info_t& info) {
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

bool TakeFaults::pass(Message& message, std::size_t& copies) {
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

void TakeFaults::put(const Message& message) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(message);
  }
  announce_();
}

bool TakeFaults::has_message() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

}  // namespace rmw_fastrtps
