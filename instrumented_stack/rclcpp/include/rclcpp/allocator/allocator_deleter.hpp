// SPDX-License-Identifier: Apache-2.0
// Returns an object to the allocator that it came from.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace rclcpp::allocator {

// Has its own copy of the allocator, so it may live longer than the one that it was given.
template <typename AllocatorT>
class AllocatorDeleter {
 public:
  // With an allocator of its own, if there is a default one; otherwise set_allocator() must come before the first use.
  AllocatorDeleter() {
    if constexpr (std::is_default_constructible_v<AllocatorT>) {
      allocator_.emplace();
    }
  }
  explicit AllocatorDeleter(const AllocatorT& allocator) : allocator_(allocator) {}
  explicit AllocatorDeleter(AllocatorT* allocator) { set_allocator(allocator); }
  template <typename OtherT>
  explicit AllocatorDeleter(const AllocatorDeleter<OtherT>& other) {
    if (other.get_allocator() != nullptr) {
      allocator_.emplace(*other.get_allocator());
    }
  }
  AllocatorDeleter(const AllocatorDeleter& other) = default;
  // Allocators need not be assignable.
  AllocatorDeleter& operator=(const AllocatorDeleter& other) {
    if (this != &other) {
      set_allocator(other.get_allocator());
    }
    return *this;
  }
  ~AllocatorDeleter() = default;

  template <typename T>
  void operator()(T* object) {
    using Traits = typename std::allocator_traits<AllocatorT>::template rebind_traits<std::remove_const_t<T>>;
    typename Traits::allocator_type allocator(*allocator_);
    auto* memory = const_cast<std::remove_const_t<T>*>(object);
    Traits::destroy(allocator, memory);
    Traits::deallocate(allocator, memory, 1);
  }

  // Null if there is none.
  AllocatorT* get_allocator() const { return allocator_ ? &*allocator_ : nullptr; }
  void set_allocator(AllocatorT* allocator) {
    allocator_.reset();
    if (allocator != nullptr) {
      allocator_.emplace(*allocator);
    }
  }

 private:
  mutable std::optional<AllocatorT> allocator_;
};

// For a deleter of either kind: std::default_delete needs no allocator. Throws std::invalid_argument for null.
template <typename T, typename U>
void set_allocator_for_deleter(std::default_delete<T>* /*deleter*/, std::allocator<U>* /*allocator*/) {}

// For any other deleter: throws std::runtime_error.
template <typename AllocatorT, typename T, typename DeleterT>
void set_allocator_for_deleter(DeleterT* /*deleter*/, AllocatorT* /*allocator*/) {
  throw std::runtime_error("Reached unexpected template specialization");
}

template <typename AllocatorT, typename T>
void set_allocator_for_deleter(AllocatorDeleter<T>* deleter, AllocatorT* allocator) {
  if (deleter == nullptr || allocator == nullptr) {
    throw std::invalid_argument("Argument was NULL to set_allocator_for_deleter");
  }
  T converted(*allocator);
  deleter->set_allocator(&converted);
}

}  // namespace rclcpp::allocator
