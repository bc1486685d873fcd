// SPDX-License-Identifier: Apache-2.0
#include "rcutils/allocator.h"

#include <cstdlib>

rcutils_allocator_t rcutils_get_zero_initialized_allocator(void) {
  return {};
}

rcutils_allocator_t rcutils_get_default_allocator(void) {
  rcutils_allocator_t allocator;
  allocator.allocate = [](size_t size, void*) { return std::malloc(size); };
  allocator.deallocate = [](void* pointer, void*) { std::free(pointer); };
  allocator.reallocate = [](void* pointer, size_t size, void*) { return std::realloc(pointer, size); };
  allocator.zero_allocate = [](size_t count, size_t size, void*) { return std::calloc(count, size); };
  allocator.state = nullptr;
  return allocator;
}

bool rcutils_allocator_is_valid(const rcutils_allocator_t* allocator) {
  return allocator != nullptr && allocator->allocate != nullptr && allocator->deallocate != nullptr &&
         allocator->reallocate != nullptr && allocator->zero_allocate != nullptr;
}

void* rcutils_reallocf(void* pointer, size_t size, rcutils_allocator_t* allocator) {
  if (!rcutils_allocator_is_valid(allocator)) {
    return nullptr;
  }
  void* memory = allocator->reallocate(pointer, size, allocator->state);
  if (memory == nullptr) {
    allocator->deallocate(pointer, allocator->state);
  }
  return memory;
}
