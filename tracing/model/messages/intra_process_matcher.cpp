// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/intra_process_matcher.hpp"

namespace tracing {

void IntraProcessMatcher::on(const Origin& origin, const ros2::RclcppConstructRingBuffer& event) {
  // A state dump repeats the event for a buffer that may hold messages.
  buffers_.try_emplace({origin.process, event.buffer});
}

void IntraProcessMatcher::on(const Origin& origin, const ros2::RclcppBufferToIpb& event) {
  buffer_of_ipb_[{origin.process, event.ipb}] = event.buffer;
}

void IntraProcessMatcher::on(const Origin& origin, const ros2::RclcppIpbToSubscription& event) {
  const auto buffer = buffer_of_ipb_.find({origin.process, event.ipb});
  if (buffer == buffer_of_ipb_.end()) {
    return;
  }
  Buffer& known = buffers_[{origin.process, buffer->second}];
  if (known.subscription_object != event.subscription) {
    known.slots.clear();
  }
  known.subscription_object = event.subscription;
}

void IntraProcessMatcher::enqueue(const Origin& origin, const ros2::RclcppRingBufferEnqueue& event,
                                  const std::optional<Publication>& publication) {
  Buffer& buffer = buffers_[{origin.process, event.buffer}];
  // The buffer of a publisher for late subscriptions always is full; nothing gets lost there.
  if (event.overwritten && buffer.subscription_object != 0) {
    ++record_.overwritten;
    // Asked now: at the end of the trace, the object may be gone, or another one at its address.
    const ObjectId subscription = model_.subscription_of_object(origin.process, buffer.subscription_object);
    if (subscription != kNoObject) {
      ++overwritten_[subscription];
    } else {
      ++overwritten_of_unknown_[{origin.process, buffer.subscription_object}];
    }
  }
  buffer.slots[event.index] = publication.value_or(Publication());
}

BufferedMessage IntraProcessMatcher::dequeue(const Origin& origin, const ros2::RclcppRingBufferDequeue& event) {
  Buffer& buffer = buffers_[{origin.process, event.buffer}];
  BufferedMessage message{model_.subscription_of_object(origin.process, buffer.subscription_object), {}};
  if (auto slot = buffer.slots.extract(event.index)) {
    message.publication = slot.mapped();
  } else {
    ++record_.unknown;
  }
  return message;
}

std::map<ObjectId, std::uint64_t> IntraProcessMatcher::overwritten() const {
  std::map<ObjectId, std::uint64_t> overwritten = overwritten_;
  for (const auto& [object, count] : overwritten_of_unknown_) {
    const ObjectId subscription = model_.subscription_of_object(object.first, object.second);
    if (subscription != kNoObject) {
      overwritten[subscription] += count;
    }
  }
  return overwritten;
}

std::uint64_t IntraProcessMatcher::overwritten_of(ObjectId subscription) const {
  const auto known = overwritten_.find(subscription);
  std::uint64_t sum = known == overwritten_.end() ? 0 : known->second;
  for (const auto& [object, count] : overwritten_of_unknown_) {
    if (model_.subscription_of_object(object.first, object.second) == subscription) {
      sum += count;
    }
  }
  return sum;
}

void IntraProcessMatcher::clear(const Origin& origin, const ros2::RclcppRingBufferClear& event) {
  Buffer& buffer = buffers_[{origin.process, event.buffer}];
  record_.cleared += buffer.slots.size();
  buffer.slots.clear();
}

}  // namespace tracing
