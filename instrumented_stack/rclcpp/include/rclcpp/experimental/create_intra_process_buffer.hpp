// SPDX-License-Identifier: Apache-2.0
// Creates the buffer of a subscription or of a transient local publisher.
#pragma once

#include <memory>
#include <stdexcept>

#include "rclcpp/experimental/buffers/intra_process_buffer.hpp"
#include "rclcpp/experimental/buffers/ring_buffer_implementation.hpp"
#include "rclcpp/intra_process_buffer_type.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp::experimental {

// Throws std::invalid_argument for a depth of 0, std::runtime_error if the buffer type is not resolved.
template <typename MessageT, typename AllocatorT>
typename buffers::IntraProcessBuffer<MessageT, AllocatorT>::SharedPtr create_intra_process_buffer(
    IntraProcessBufferType buffer_type, const QoS& qos, const AllocatorT& allocator) {
  const auto create = [&](auto pointer) {
    using BufferT = decltype(pointer);
    return std::make_shared<
        buffers::TypedIntraProcessBuffer<MessageT, AllocatorT, allocator::Deleter<AllocatorT, MessageT>, BufferT>>(
        std::make_unique<buffers::RingBufferImplementation<BufferT>>(qos.depth()), allocator);
  };
  using Buffer = buffers::IntraProcessBuffer<MessageT, AllocatorT>;
  typename Buffer::SharedPtr buffer;
  switch (buffer_type) {
    case IntraProcessBufferType::SharedPtr:
      buffer = create(typename Buffer::MessageSharedPtr());
      break;
    case IntraProcessBufferType::UniquePtr:
      buffer = create(typename Buffer::MessageUniquePtr());
      break;
    case IntraProcessBufferType::CallbackDefault:
      throw std::runtime_error("Unrecognized IntraProcessBufferType value");
  }
  return buffer;
}

}  // namespace rclcpp::experimental
