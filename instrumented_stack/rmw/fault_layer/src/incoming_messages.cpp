// SPDX-License-Identifier: Apache-2.0
#include "incoming_messages.hpp"

#include <cstring>
#include <utility>

#include "faults/delayed_calls.hpp"

namespace rmw_fault_layer {

using rmw_fastrtps::delayed_calls;
using rmw_fastrtps::DelayedCalls;
using rmw_fastrtps::MessageFate;

IncomingMessages::IncomingMessages(std::unique_ptr<rmw_fastrtps::MessageFaults> faults, std::size_t size_of_info,
                                   std::string name, rmw_context_t* context)
    : faults_(std::move(faults)),
      size_of_info_(size_of_info),
      name_(std::move(name)),
      guard_condition_(next<decltype(rmw_create_guard_condition)>("rmw_create_guard_condition")(context)) {}

IncomingMessages::~IncomingMessages() {
  delayed_calls().forget(this);
  (void)next<decltype(rmw_destroy_guard_condition)>("rmw_destroy_guard_condition")(guard_condition_);
}

rmw_ret_t IncomingMessages::take(const Access& access, void* info, bool& taken) {
  const auto hand_out = [&](const Info& of_message) {
    if (info != nullptr) {
      std::memcpy(info, of_message.data(), size_of_info_);
    }
    taken = true;
    return RMW_RET_OK;
  };
  while (true) {
    Message message;
    {
      const std::lock_guard lock(mutex_);
      if (!waiting_.empty()) {
        message = std::move(waiting_.front());
        waiting_.pop_front();
      }
    }
    if (!message.info.empty()) {
      if (access.set(message.bytes)) {
        return hand_out(message.info);
      }
      continue;  // nobody can read it: it is lost
    }
    taken = false;
    message.info.resize(kMostOfMessageInfo);
    if (const rmw_ret_t result = access.take(message.info.data(), taken); result != RMW_RET_OK || !taken) {
      return result;
    }
    const MessageFate fate = faults_->next();
    taken = false;
    if (fate.is_dropped) {
      continue;
    }
    if (fate.is_usual()) {
      return hand_out(message.info);
    }
    message.bytes = access.bytes();
    if (message.bytes.empty()) {
      not_serialized_.tell(name_.c_str());
      return hand_out(message.info);
    }
    for (const std::uint64_t seed : fate.corruptions) {
      rmw_fastrtps::corrupt(message.bytes.data(), message.bytes.size(), seed);
    }
    if (fate.delay.count() != 0) {
      const auto due = DelayedCalls::Clock::now() + fate.delay;
      for (unsigned copy = 0; copy < fate.copies; ++copy) {
        delayed_calls().add(this, due, [this, message] { put(message); });
      }
      continue;
    }
    for (unsigned copy = 1; copy < fate.copies; ++copy) {
      put(message);
    }
    if (fate.corruptions.empty() || access.set(message.bytes)) {
      return hand_out(message.info);
    }
  }
}

bool IncomingMessages::has_message() const {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

void IncomingMessages::set_callback(rmw_event_callback_t callback, const void* user_data) {
  const std::lock_guard lock(callback_mutex_);
  callback_ = callback;
  user_data_ = user_data;
}

void IncomingMessages::put(const Message& message) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(message);
  }
  (void)next<decltype(rmw_trigger_guard_condition)>("rmw_trigger_guard_condition")(guard_condition_);
  const std::lock_guard lock(callback_mutex_);
  if (callback_ != nullptr) {
    callback_(user_data_, 1);
  }
}

}  // namespace rmw_fault_layer
