// SPDX-License-Identifier: Apache-2.0
// Keeps messages between publisher and callback of one process.
#pragma once

#include <cstddef>
#include <vector>

namespace rclcpp::experimental::buffers {

// Thread safe. BufferT is a shared or unique pointer to a message.
template <typename BufferT>
class BufferImplementationBase {
 public:
  virtual ~BufferImplementationBase() = default;

  // Removes the oldest message; null if there is none.
  virtual BufferT dequeue() = 0;
  virtual void enqueue(BufferT request) = 0;

  // All messages, oldest first. They stay in the buffer. For unique pointers the messages are copied.
  virtual std::vector<BufferT> get_all_data() = 0;

  virtual void clear() = 0;
  virtual bool has_data() const = 0;
  virtual size_t available_capacity() const = 0;
};

}  // namespace rclcpp::experimental::buffers
