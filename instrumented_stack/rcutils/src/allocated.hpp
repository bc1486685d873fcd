// SPDX-License-Identifier: Apache-2.0
// C++ containers whose memory comes from an allocator of C.
#pragma once

#include <new>
#include <string>
#include <utility>
#include <vector>

#include "rcutils/allocator.h"

namespace rcutils {

// Throws std::bad_alloc if there is no memory.
template <class T>
struct Memory {
  using value_type = T;
  rcutils_allocator_t allocator;

  explicit Memory(const rcutils_allocator_t& from) : allocator(from) {}
  template <class U>
  Memory(const Memory<U>& other) : allocator(other.allocator) {}  // NOLINT(google-explicit-constructor)

  T* allocate(size_t count) {
    // NOLINTNEXTLINE(bugprone-sizeof-expression): T may well be a pointer
    void* memory = allocator.allocate(count * sizeof(T), allocator.state);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t) { allocator.deallocate(memory, allocator.state); }

  template <class U>
  bool operator==(const Memory<U>& other) const {
    return allocator.state == other.allocator.state && allocator.deallocate == other.allocator.deallocate;
  }
};

using Text = std::basic_string<char, std::char_traits<char>, Memory<char>>;

template <class T>
using List = std::vector<T, Memory<T>>;

// An object in memory of the allocator, made of the other arguments. Throws std::bad_alloc.
template <class T, class... Arguments>
T* make(const rcutils_allocator_t& allocator, Arguments&&... arguments) {
  Memory<T> memory(allocator);
  T* object = memory.allocate(1);
  try {
    return new (object) T{std::forward<Arguments>(arguments)...};
  } catch (...) {
    memory.deallocate(object, 1);
    throw;
  }
}

template <class T>
void destroy(const rcutils_allocator_t& allocator, T* object) {
  object->~T();
  allocator.deallocate(object, allocator.state);
}

}  // namespace rcutils
