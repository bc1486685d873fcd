// SPDX-License-Identifier: Apache-2.0
// A buffer of fixed capacity. A new message replaces the oldest: history "keep last".
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/detail/intra_process_trace.hpp"
#include "rclcpp/experimental/buffers/buffer_implementation_base.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::experimental::buffers {

template <typename BufferT>
class RingBufferImplementation : public BufferImplementationBase<BufferT> {
 public:
  // Throws std::invalid_argument for a capacity of 0.
  explicit RingBufferImplementation(size_t capacity) : ring_buffer_(capacity), write_index_(capacity - 1) {
    if (capacity == 0) {
      throw std::invalid_argument("capacity must be a positive, non-zero value");
    }
    rclcpp::detail::trace_construct_ring_buffer(this, capacity);
  }
  ~RingBufferImplementation() override { rclcpp::detail::trace_ring_buffer_fini(this); }
  RCLCPP_DISABLE_COPY(RingBufferImplementation)

  void enqueue(BufferT request) override {
    // An overwritten message moves to `request`, which is destroyed after the lock is released.
    const std::lock_guard lock(mutex_);
    write_index_ = next(write_index_);
    std::swap(ring_buffer_[write_index_], request);
    const bool overwritten = is_full_unlocked();
    rclcpp::detail::trace_ring_buffer_enqueue(this, write_index_, size_ + 1, overwritten);
    if (overwritten) {
      read_index_ = next(read_index_);
    } else {
      ++size_;
    }
  }

  BufferT dequeue() override {
    const std::lock_guard lock(mutex_);
    if (size_ == 0) {
      return BufferT();
    }
    BufferT request = std::move(ring_buffer_[read_index_]);
    rclcpp::detail::trace_ring_buffer_dequeue(this, read_index_, size_ - 1);
    --size_;
    read_index_ = next(read_index_);
    return request;
  }

  std::vector<BufferT> get_all_data() override {
    const std::lock_guard lock(mutex_);
    std::vector<BufferT> all;
    all.reserve(size_);
    for (size_t i = 0, index = read_index_; i < size_; ++i, index = next(index)) {
      if constexpr (std::is_copy_constructible_v<BufferT>) {
        all.push_back(ring_buffer_[index]);
      } else {
        using MessageT = typename BufferT::element_type;
        all.push_back(BufferT(ring_buffer_[index] ? new MessageT(*ring_buffer_[index]) : nullptr));
      }
    }
    return all;
  }

  void clear() override {
    rclcpp::detail::trace_ring_buffer_clear(this);
    std::vector<BufferT> cleared(ring_buffer_.size());  // destroyed after the lock is released
    const std::lock_guard lock(mutex_);
    ring_buffer_.swap(cleared);
    write_index_ = ring_buffer_.size() - 1;
    read_index_ = 0;
    size_ = 0;
  }

  size_t next(size_t index) const { return index + 1 == ring_buffer_.size() ? 0 : index + 1; }

  bool has_data() const override {
    const std::lock_guard lock(mutex_);
    return size_ != 0;
  }

  bool is_full() const {
    const std::lock_guard lock(mutex_);
    return is_full_unlocked();
  }

  size_t available_capacity() const override {
    const std::lock_guard lock(mutex_);
    return ring_buffer_.size() - size_;
  }

 private:
  bool is_full_unlocked() const { return size_ == ring_buffer_.size(); }

  mutable std::mutex mutex_;
  std::vector<BufferT> ring_buffer_;
  size_t write_index_;  // position of the newest message
  size_t read_index_ = 0;
  size_t size_ = 0;
};

}  // namespace rclcpp::experimental::buffers
