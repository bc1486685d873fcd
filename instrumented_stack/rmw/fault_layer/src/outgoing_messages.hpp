// SPDX-License-Identifier: Apache-2.0
// The messages of a publisher, sent as its faults want it.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "faults/message_faults.hpp"
#include "middleware.hpp"

namespace rmw_fault_layer {

class OutgoingMessages {
 public:
  OutgoingMessages(const rmw_publisher_t* publisher, const rosidl_message_type_support_t* type,
                   std::unique_ptr<rmw_fastrtps::MessageFaults> faults)
      : publisher_(publisher), type_(type), faults_(std::move(faults)) {}
  // Messages that are late are lost.
  ~OutgoingMessages();
  OutgoingMessages(const OutgoingMessages&) = delete;
  OutgoingMessages& operator=(const OutgoingMessages&) = delete;

  // `send` gives the message to the middleware as it is, `bytes` serializes it. A message that is dropped, or that is
  // sent later, counts as sent.
  rmw_ret_t publish(const std::function<rmw_ret_t()>& send, const std::function<Bytes()>& bytes);

  const rosidl_message_type_support_t* type() const { return type_; }

 private:
  rmw_ret_t send(const Bytes& bytes) const;

  const rmw_publisher_t* publisher_;
  const rosidl_message_type_support_t* type_;
  std::unique_ptr<rmw_fastrtps::MessageFaults> faults_;
  NotSerialized not_serialized_;
};

}  // namespace rmw_fault_layer
