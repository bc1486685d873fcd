// SPDX-License-Identifier: Apache-2.0
// How a subscription keeps the messages of publishers of its own context until its callback takes them.
#pragma once

namespace rclcpp {

enum class IntraProcessBufferType {
  SharedPtr,        // shared with other subscriptions
  UniquePtr,        // of its own: a copy is made when there are others
  CallbackDefault,  // shared if the callback leaves the message unchanged, else its own
};

namespace detail {

// CallbackDefault resolved for a callback.
template <typename CallbackT>
IntraProcessBufferType resolve_intra_process_buffer_type(IntraProcessBufferType type, const CallbackT& callback) {
  if (type != IntraProcessBufferType::CallbackDefault) {
    return type;
  }
  return callback.use_take_shared_method() ? IntraProcessBufferType::SharedPtr : IntraProcessBufferType::UniquePtr;
}

}  // namespace detail

}  // namespace rclcpp
