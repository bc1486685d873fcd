// SPDX-License-Identifier: Apache-2.0
// Returns an object to the allocator that it came from.
#pragma once

#include <memory>

namespace rclcpp::allocator {

template <typename AllocatorT>
class AllocatorDeleter {
 public:
  AllocatorDeleter() = default;
  explicit AllocatorDeleter(const AllocatorT& allocator) : allocator_(allocator) {}

  void operator()(typename std::allocator_traits<AllocatorT>::value_type* object) {
    std::allocator_traits<AllocatorT>::destroy(allocator_, object);
    std::allocator_traits<AllocatorT>::deallocate(allocator_, object, 1);
  }

  const AllocatorT& get_allocator() const { return allocator_; }

 private:
  AllocatorT allocator_;
};

}  // namespace rclcpp::allocator
