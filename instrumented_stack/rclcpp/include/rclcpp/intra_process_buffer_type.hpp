// SPDX-License-Identifier: Apache-2.0
// How a subscription keeps messages from publishers of its own context until its callback takes them.
#pragma once

namespace rclcpp {

enum class IntraProcessBufferType {
  SharedPtr,        // shared with other subscriptions
  UniquePtr,        // owned by the subscription: copied if there are others
  CallbackDefault,  // shared if the callback leaves the message unchanged, else owned
};

namespace detail {

// Resolves CallbackDefault for a callback.
template <typename CallbackT>
IntraProcessBufferType resolve_intra_process_buffer_type(IntraProcessBufferType type, const CallbackT& callback) {
  if (type != IntraProcessBufferType::CallbackDefault) {
    return type;
  }
  return callback.use_take_shared_method() ? IntraProcessBufferType::SharedPtr : IntraProcessBufferType::UniquePtr;
}

}  // namespace detail

}  // namespace rclcpp
