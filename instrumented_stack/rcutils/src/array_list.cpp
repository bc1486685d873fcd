// SPDX-License-Identifier: Apache-2.0
#include "rcutils/types/array_list.h"

#include <cstdint>

struct rcutils_array_list_impl_s {
  uint8_t* bytes;
  size_t size;
  size_t capacity;
  size_t data_size;
  rcutils_allocator_t allocator;

  uint8_t* at(size_t index) const { return bytes + index * data_size; }
};

namespace {

bool is_inside(const rcutils_array_list_t* list, size_t index) {
  if (index < list->impl->size) {
    return true;
  }
  RCUTILS_SET_ERROR_MSG("index is out of bounds of the list");
  return false;
}

rcutils_ret_t grow(rcutils_array_list_impl_s& list) {
  void* bytes = list.allocator.reallocate(list.bytes, 2 * list.capacity * list.data_size, list.allocator.state);
  if (bytes == nullptr) {
    RCUTILS_SET_ERROR_MSG("out of memory for an array list");
    return RCUTILS_RET_BAD_ALLOC;
  }
  list.bytes = static_cast<uint8_t*>(bytes);
  list.capacity *= 2;
  return RCUTILS_RET_OK;
}

}  // namespace

rcutils_array_list_t rcutils_get_zero_initialized_array_list(void) {
  return {};
}

rcutils_ret_t rcutils_array_list_init(rcutils_array_list_t* array_list, size_t initial_capacity, size_t data_size,
                                      const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array_list, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "array list has no valid allocator", return RCUTILS_RET_INVALID_ARGUMENT)
  if (array_list->impl != nullptr || initial_capacity == 0 || data_size == 0) {
    RCUTILS_SET_ERROR_MSG(array_list->impl != nullptr ? "array_list is already initialized"
                          : initial_capacity == 0     ? "initial_capacity cannot be less than 1"
                                                      : "data_size cannot be less than 1");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  void* memory = allocator->allocate(sizeof(rcutils_array_list_impl_s), allocator->state);
  void* bytes = memory == nullptr ? nullptr : allocator->allocate(initial_capacity * data_size, allocator->state);
  if (bytes == nullptr) {
    allocator->deallocate(memory, allocator->state);
    RCUTILS_SET_ERROR_MSG("out of memory for an array list");
    return RCUTILS_RET_BAD_ALLOC;
  }
  array_list->impl = static_cast<rcutils_array_list_impl_s*>(memory);
  *array_list->impl = {static_cast<uint8_t*>(bytes), 0, initial_capacity, data_size, *allocator};
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_fini(rcutils_array_list_t* array_list) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  const rcutils_allocator_t allocator = array_list->impl->allocator;
  allocator.deallocate(array_list->impl->bytes, allocator.state);
  allocator.deallocate(array_list->impl, allocator.state);
  array_list->impl = nullptr;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_add(rcutils_array_list_t* array_list, const void* data) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(data, RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_array_list_impl_s& list = *array_list->impl;
  if (list.size == list.capacity) {
    const rcutils_ret_t result = grow(list);
    if (result != RCUTILS_RET_OK) {
      return result;
    }
  }
  memcpy(list.at(list.size++), data, list.data_size);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_set(rcutils_array_list_t* array_list, size_t index, const void* data) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(data, RCUTILS_RET_INVALID_ARGUMENT);
  if (!is_inside(array_list, index)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  memcpy(array_list->impl->at(index), data, array_list->impl->data_size);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_get(const rcutils_array_list_t* array_list, size_t index, void* data) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(data, RCUTILS_RET_INVALID_ARGUMENT);
  if (!is_inside(array_list, index)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  memcpy(data, array_list->impl->at(index), array_list->impl->data_size);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_remove(rcutils_array_list_t* array_list, size_t index) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  if (!is_inside(array_list, index)) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  rcutils_array_list_impl_s& list = *array_list->impl;
  memmove(list.at(index), list.at(index + 1), (list.size - index - 1) * list.data_size);
  --list.size;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_array_list_get_size(const rcutils_array_list_t* array_list, size_t* size) {
  ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(size, RCUTILS_RET_INVALID_ARGUMENT);
  *size = array_list->impl->size;
  return RCUTILS_RET_OK;
}
