// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "rcutils/error_handling.h"
#include "rcutils/types/string_array.h"
#include "rcutils/types/uint8_array.h"

rcutils_uint8_array_t rcutils_get_zero_initialized_uint8_array(void) {
  return {};
}

rcutils_ret_t rcutils_uint8_array_init(rcutils_uint8_array_t* array, size_t capacity,
                                       const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RCUTILS_RET_INVALID_ARGUMENT);
  if (!rcutils_allocator_is_valid(allocator)) {
    RCUTILS_SET_ERROR_MSG("byte array has no valid allocator");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  *array = {nullptr, 0, 0, *allocator};
  return capacity == 0 ? RCUTILS_RET_OK : rcutils_uint8_array_resize(array, capacity);
}

rcutils_ret_t rcutils_uint8_array_fini(rcutils_uint8_array_t* array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RCUTILS_RET_INVALID_ARGUMENT);
  if (array->buffer != nullptr) {
    array->allocator.deallocate(array->buffer, array->allocator.state);
  }
  array->buffer = nullptr;
  array->buffer_length = array->buffer_capacity = 0;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_uint8_array_resize(rcutils_uint8_array_t* array, size_t new_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RCUTILS_RET_INVALID_ARGUMENT);
  if (new_size == 0) {
    RCUTILS_SET_ERROR_MSG("byte array cannot be resized to 0 bytes");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (!rcutils_allocator_is_valid(&array->allocator)) {
    RCUTILS_SET_ERROR_MSG("byte array has no valid allocator");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  if (new_size == array->buffer_capacity) {
    return RCUTILS_RET_OK;
  }
  void* buffer = array->allocator.reallocate(array->buffer, new_size, array->allocator.state);
  if (buffer == nullptr) {
    RCUTILS_SET_ERROR_MSG("out of memory for a byte array");
    return RCUTILS_RET_BAD_ALLOC;
  }
  array->buffer = static_cast<uint8_t*>(buffer);
  array->buffer_capacity = new_size;
  array->buffer_length = std::min(array->buffer_length, new_size);
  return RCUTILS_RET_OK;
}

rcutils_string_array_t rcutils_get_zero_initialized_string_array(void) {
  return {};
}

rcutils_ret_t rcutils_string_array_init(rcutils_string_array_t* array, size_t size,
                                        const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RCUTILS_RET_INVALID_ARGUMENT);
  if (!rcutils_allocator_is_valid(allocator)) {
    RCUTILS_SET_ERROR_MSG("string array has no valid allocator");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  *array = {size, nullptr, *allocator};
  if (size != 0) {
    array->data = static_cast<char**>(allocator->zero_allocate(size, sizeof(char*), allocator->state));
    if (array->data == nullptr) {
      array->size = 0;
      RCUTILS_SET_ERROR_MSG("out of memory for a string array");
      return RCUTILS_RET_BAD_ALLOC;
    }
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_array_fini(rcutils_string_array_t* array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RCUTILS_RET_INVALID_ARGUMENT);
  if (array->data != nullptr) {
    for (size_t i = 0; i < array->size; ++i) {
      array->allocator.deallocate(array->data[i], array->allocator.state);
    }
    array->allocator.deallocate(array->data, array->allocator.state);
  }
  array->data = nullptr;
  array->size = 0;
  return RCUTILS_RET_OK;
}
