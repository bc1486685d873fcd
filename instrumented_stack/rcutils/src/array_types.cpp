// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "rcutils/error_handling.h"
#include "rcutils/qsort.h"
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

rcutils_ret_t rcutils_string_array_resize(rcutils_string_array_t* array, size_t new_size) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(array, "string_array is null", return RCUTILS_RET_INVALID_ARGUMENT);
  if (array->size == new_size) {
    return RCUTILS_RET_OK;
  }
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&array->allocator, "allocator is invalid", return RCUTILS_RET_INVALID_ARGUMENT)
  // A new array: if there is no memory for it, the old one is as it was.
  rcutils_string_array_t resized;
  const rcutils_ret_t made = rcutils_string_array_init(&resized, new_size, &array->allocator);
  if (made != RCUTILS_RET_OK) {
    return made;
  }
  const size_t kept = std::min(array->size, new_size);
  for (size_t i = 0; i < kept; ++i) {
    std::swap(resized.data[i], array->data[i]);
  }
  std::swap(resized, *array);
  return rcutils_string_array_fini(&resized);
}

rcutils_ret_t rcutils_string_array_cmp(const rcutils_string_array_t* lhs, const rcutils_string_array_t* rhs, int* res) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(lhs, "lhs string array is null", return RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(rhs, "rhs string array is null", return RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(res, "res argument is null", return RCUTILS_RET_INVALID_ARGUMENT);
  const size_t common = std::min(lhs->size, rhs->size);
  if (common != 0) {
    RCUTILS_CHECK_FOR_NULL_WITH_MSG(lhs->data, "lhs->data is null", return RCUTILS_RET_INVALID_ARGUMENT);
    RCUTILS_CHECK_FOR_NULL_WITH_MSG(rhs->data, "rhs->data is null", return RCUTILS_RET_INVALID_ARGUMENT);
  }
  for (size_t i = 0; i < common; ++i) {
    RCUTILS_CHECK_FOR_NULL_WITH_MSG(lhs->data[i], "lhs array element is null", return RCUTILS_RET_ERROR);
    RCUTILS_CHECK_FOR_NULL_WITH_MSG(rhs->data[i], "rhs array element is null", return RCUTILS_RET_ERROR);
    *res = std::strcmp(lhs->data[i], rhs->data[i]);
    if (*res != 0) {
      return RCUTILS_RET_OK;
    }
  }
  *res = lhs->size < rhs->size ? -1 : lhs->size > rhs->size ? 1 : 0;
  return RCUTILS_RET_OK;
}

int rcutils_string_array_sort_compare(const void* lhs, const void* rhs) {
  const char* const left = *static_cast<const char* const*>(lhs);
  const char* const right = *static_cast<const char* const*>(rhs);
  if (left == nullptr || right == nullptr) {
    return (left == nullptr ? 1 : 0) - (right == nullptr ? 1 : 0);
  }
  return std::strcmp(left, right);
}

rcutils_ret_t rcutils_string_array_sort(rcutils_string_array_t* array) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(array, "string_array is null", return RCUTILS_RET_INVALID_ARGUMENT);
  return rcutils_qsort(array->data, array->size, sizeof(char*), rcutils_string_array_sort_compare);
}
