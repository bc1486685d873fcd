// SPDX-License-Identifier: Apache-2.0
// Messages of a subscription in memory that is there from the start.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <rosidl_runtime_cpp/traits.hpp>
#include <stdexcept>
#include <type_traits>

#include "rclcpp/macros.hpp"
#include "rclcpp/message_memory_strategy.hpp"

namespace rclcpp::strategies::message_pool_memory_strategy {

// Has `Size` messages of a type whose size is fixed. A message is in use from the moment a subscription takes it until
// the last pointer to it is gone, also one that the callback has kept, and also after the end of the strategy. So there
// must be as many messages as threads of the executor, and as callbacks keep.
template <typename MessageT, size_t Size,
          std::enable_if_t<rosidl_generator_traits::has_fixed_size<MessageT>::value>* = nullptr>
class MessagePoolMemoryStrategy : public message_memory_strategy::MessageMemoryStrategy<MessageT> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MessagePoolMemoryStrategy)

  // A new message in free memory. Throws std::runtime_error if all are in use.
  std::shared_ptr<MessageT> borrow_message() override {
    MessageT* message = new (pool_->take()) MessageT();
    return std::shared_ptr<MessageT>(message, [pool = pool_](MessageT* used) {
      used->~MessageT();
      pool->give_back(used);
    });
  }

  // The last pointer gives the message back.
  void return_message(std::shared_ptr<MessageT>& /*msg*/) override {}

 private:
  class Pool {
   public:
    Pool() {
      for (size_t i = 0; i < Size; ++i) {
        free_[i] = &memory_[i];
      }
    }

    void* take() {
      const std::lock_guard lock(mutex_);
      if (free_count_ == 0) {
        throw std::runtime_error("No more free slots in the pool");
      }
      return free_[--free_count_];
    }

    void give_back(void* memory) {
      const std::lock_guard lock(mutex_);
      free_[free_count_++] = memory;
    }

   private:
    struct alignas(MessageT) Memory {
      std::byte bytes[sizeof(MessageT)];
    };

    std::mutex mutex_;
    std::array<Memory, Size> memory_;
    std::array<void*, Size> free_;
    size_t free_count_ = Size;
  };

  // Messages hold it, too.
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
};

}  // namespace rclcpp::strategies::message_pool_memory_strategy
