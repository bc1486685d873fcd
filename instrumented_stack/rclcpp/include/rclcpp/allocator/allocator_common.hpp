// SPDX-License-Identifier: Apache-2.0
// Creates messages in the memory of a user's allocator: the AllocatorT of publishers and subscriptions.
#pragma once

#include <rcutils/allocator.h>

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
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

// The functions of an allocator of C that take their memory from an allocator of C++. Such an allocator must be told
// how large a piece is that it gets back, so the size stands before each piece.
template <typename AllocatorT>
struct InC {
  struct alignas(std::max_align_t) Unit {
    std::size_t units;
    std::byte rest[sizeof(std::max_align_t) - sizeof(std::size_t)];
  };
  using Traits = AllocRebind<Unit, AllocatorT>;
  using Units = typename Traits::allocator_type;

  static void* allocate(std::size_t size, void* state) {
    const std::size_t count = 1 + (size + sizeof(Unit) - 1) / sizeof(Unit);
    Units units(*static_cast<AllocatorT*>(state));
    try {
      Unit* first = Traits::allocate(units, count);
      first->units = count;
      return first + 1;
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
  }
  static void deallocate(void* memory, void* state) {
    if (memory != nullptr) {
      Units units(*static_cast<AllocatorT*>(state));
      Unit* first = static_cast<Unit*>(memory) - 1;
      Traits::deallocate(units, first, first->units);
    }
  }
  static void* reallocate(void* memory, std::size_t size, void* state) {
    void* larger = allocate(size, state);
    if (larger != nullptr && memory != nullptr) {
      const std::size_t old_size = ((static_cast<Unit*>(memory) - 1)->units - 1) * sizeof(Unit);
      std::memcpy(larger, memory, old_size < size ? old_size : size);
      deallocate(memory, state);
    }
    return larger;
  }
  static void* zero_allocate(std::size_t count, std::size_t size, void* state) {
    if (size != 0 && count > static_cast<std::size_t>(-1) / 2 / size) {
      return nullptr;
    }
    void* memory = allocate(count * size, state);
    return memory == nullptr ? nullptr : std::memset(memory, 0, count * size);
  }
};

// Functions of an allocator of C whose state is an `AllocatorT` for elements of one byte (retyped_deallocate() and
// retyped_reallocate(): for one T). get_rcl_allocator() below needs no such conditions. Throw std::runtime_error
// without a state.
template <typename AllocatorT>
AllocatorT& retyped(void* untyped_allocator) {
  if (untyped_allocator == nullptr) {
    throw std::runtime_error("Received incorrect allocator type");
  }
  return *static_cast<AllocatorT*>(untyped_allocator);
}
template <typename AllocatorT>
void* retyped_allocate(std::size_t size, void* untyped_allocator) {
  return std::allocator_traits<AllocatorT>::allocate(retyped<AllocatorT>(untyped_allocator), size);
}
template <typename AllocatorT>
void* retyped_zero_allocate(std::size_t count, std::size_t size, void* untyped_allocator) {
  void* memory = retyped_allocate<AllocatorT>(count * size, untyped_allocator);
  return memory == nullptr ? nullptr : std::memset(memory, 0, count * size);
}
template <typename T, typename AllocatorT>
void retyped_deallocate(void* memory, void* untyped_allocator) {
  std::allocator_traits<AllocatorT>::deallocate(retyped<AllocatorT>(untyped_allocator), static_cast<T*>(memory), 1);
}
template <typename T, typename AllocatorT>
void* retyped_reallocate(void* memory, std::size_t size, void* untyped_allocator) {
  retyped_deallocate<T, AllocatorT>(memory, untyped_allocator);
  return retyped_allocate<AllocatorT>(size, untyped_allocator);
}

// An allocator of C that takes its memory from `allocator`, which must live longer. For the standard allocator it is
// the default one.
template <typename T, typename AllocatorT>
rcutils_allocator_t get_rcl_allocator(AllocatorT& allocator) {
  rcutils_allocator_t result = rcutils_get_default_allocator();
  if constexpr (!IsStandardAllocator<AllocatorT>::value) {
    result.allocate = InC<AllocatorT>::allocate;
    result.deallocate = InC<AllocatorT>::deallocate;
    result.reallocate = InC<AllocatorT>::reallocate;
    result.zero_allocate = InC<AllocatorT>::zero_allocate;
    result.state = &allocator;
  }
  return result;
}

}  // namespace rclcpp::allocator
