// SPDX-License-Identifier: Apache-2.0
// Memory from an allocator of C.
#pragma once

#include <rcutils/allocator.h>

#include <cstring>
#include <new>
#include <string>

namespace rcl_yaml {

// Memory for objects of C, all zero. Throws std::bad_alloc.
template <typename T>
T* zeroed(const rcutils_allocator_t& allocator, std::size_t count = 1) {
  void* memory = allocator.zero_allocate(count, sizeof(T), allocator.state);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return static_cast<T*>(memory);
}

// Makes an array longer; the new elements are zero. Throws std::bad_alloc, and the array stays as it is.
template <typename T>
void resize(const rcutils_allocator_t& allocator, T*& array, std::size_t old_size, std::size_t new_size) {
  void* memory = allocator.reallocate(array, new_size * sizeof(T), allocator.state);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  array = static_cast<T*>(memory);
  if (new_size > old_size) {
    std::memset(static_cast<void*>(array + old_size), 0, (new_size - old_size) * sizeof(T));
  }
}

// Throws std::bad_alloc.
inline char* copy_text(const rcutils_allocator_t& allocator, const std::string& text) {
  char* copy = zeroed<char>(allocator, text.size() + 1);
  std::memcpy(copy, text.data(), text.size());
  return copy;
}

template <typename T>
void release(const rcutils_allocator_t& allocator, T*& memory) {
  if (memory != nullptr) {
    allocator.deallocate(memory, allocator.state);
    memory = nullptr;
  }
}

}  // namespace rcl_yaml
