// SPDX-License-Identifier: Apache-2.0
// Creates messages in the memory of a user's allocator: the AllocatorT of publishers and subscriptions.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/allocator/allocator_deleter.hpp"

namespace rclcpp::allocator {

// The allocator for T, made from a user's `AllocatorT`, which is an allocator for void.
template <typename T, typename AllocatorT>
using Rebound = typename std::allocator_traits<AllocatorT>::template rebind_alloc<T>;

template <typename T, typename AllocatorT>
using AllocRebind = std::allocator_traits<Rebound<T, AllocatorT>>;

template <typename T>
struct IsStandardAllocator : std::false_type {};
template <typename T>
struct IsStandardAllocator<std::allocator<T>> : std::true_type {};

// The deleter for a T of that allocator. For the standard allocator it stays std::default_delete, so that users can
// write std::unique_ptr<T>.
template <typename AllocatorT, typename T>
using Deleter = std::conditional_t<IsStandardAllocator<AllocatorT>::value, std::default_delete<T>,
                                   AllocatorDeleter<Rebound<std::remove_const_t<T>, AllocatorT>>>;

template <typename T, typename AllocatorT>
using UniquePtr = std::unique_ptr<T, Deleter<AllocatorT, T>>;

template <typename T, typename AllocatorT, typename... ArgumentTs>
UniquePtr<T, AllocatorT> make_unique([[maybe_unused]] const AllocatorT& allocator, ArgumentTs&&... arguments) {
  if constexpr (IsStandardAllocator<AllocatorT>::value) {
    return std::make_unique<T>(std::forward<ArgumentTs>(arguments)...);
  } else {
    using Traits = AllocRebind<T, AllocatorT>;
    Rebound<T, AllocatorT> rebound(allocator);
    T* object = Traits::allocate(rebound, 1);
    try {
      Traits::construct(rebound, object, std::forward<ArgumentTs>(arguments)...);
    } catch (...) {
      Traits::deallocate(rebound, object, 1);
      throw;
    }
    return UniquePtr<T, AllocatorT>(object, Deleter<AllocatorT, T>(rebound));
  }
}

template <typename T, typename AllocatorT, typename... ArgumentTs>
std::shared_ptr<T> make_shared(const AllocatorT& allocator, ArgumentTs&&... arguments) {
  return std::allocate_shared<T>(Rebound<T, AllocatorT>(allocator), std::forward<ArgumentTs>(arguments)...);
}

}  // namespace rclcpp::allocator
