// SPDX-License-Identifier: Apache-2.0
#include "outgoing_messages.hpp"

#include "faults/delayed_calls.hpp"

namespace rmw_fault_layer {

using rmw_fastrtps::delayed_calls;
using rmw_fastrtps::DelayedCalls;
using rmw_fastrtps::MessageFate;

OutgoingMessages::~OutgoingMessages() {
  delayed_calls().forget(this);
}

rmw_ret_t OutgoingMessages::publish(const std::function<rmw_ret_t()>& send_as_it_is,
                                    const std::function<Bytes()>& serialized) {
  const MessageFate fate = faults_->next();
  if (fate.is_usual()) {
    return send_as_it_is();
  }
  if (fate.is_dropped) {
    return RMW_RET_OK;
  }
  const bool is_changed = fate.delay.count() != 0 || !fate.corruptions.empty();
  Bytes bytes;
  if (is_changed) {
    bytes = serialized();
    if (bytes.empty()) {
      not_serialized_.tell(publisher_->topic_name);
      return send_as_it_is();
    }
    for (const std::uint64_t seed : fate.corruptions) {
      rmw_fastrtps::corrupt(bytes.data(), bytes.size(), seed);
    }
  }
  rmw_ret_t result = RMW_RET_OK;
  const auto due = DelayedCalls::Clock::now() + fate.delay;
  for (unsigned copy = 0; copy < fate.copies && result == RMW_RET_OK; ++copy) {
    if (fate.delay.count() != 0) {
      delayed_calls().add(this, due, [this, bytes] { (void)send(bytes); });
    } else {
      result = is_changed ? send(bytes) : send_as_it_is();
    }
  }
  return result;
}

rmw_ret_t OutgoingMessages::send(const Bytes& bytes) const {
  static auto* const publish_next = next<decltype(rmw_publish_serialized_message)>("rmw_publish_serialized_message");
  const rmw_serialized_message_t message = view(bytes);
  return publish_next(publisher_, &message, nullptr);
}

}  // namespace rmw_fault_layer
