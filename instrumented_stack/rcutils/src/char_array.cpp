// SPDX-License-Identifier: Apache-2.0
#include "rcutils/types/char_array.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "rcutils/error_handling.h"

rcutils_char_array_t rcutils_get_zero_initialized_char_array(void) {
  rcutils_char_array_t array = {};
  array.owns_buffer = true;
  return array;
}

rcutils_ret_t rcutils_char_array_init(rcutils_char_array_t* char_array, size_t buffer_capacity,
                                      const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "char array has no valid allocator", return RCUTILS_RET_ERROR)
  const rcutils_allocator_t copy = *allocator;  // which may be the array's own
  *char_array = {nullptr, true, 0, 0, copy};
  if (buffer_capacity != 0) {
    char_array->buffer = static_cast<char*>(copy.allocate(buffer_capacity, copy.state));
    if (char_array->buffer == nullptr) {
      RCUTILS_SET_ERROR_MSG("failed to allocate memory for char array");
      return RCUTILS_RET_BAD_ALLOC;
    }
    char_array->buffer[0] = '\0';
    char_array->buffer_capacity = buffer_capacity;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_fini(rcutils_char_array_t* char_array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  if (char_array->owns_buffer) {
    RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&char_array->allocator, "char array has no valid allocator",
                                     return RCUTILS_RET_ERROR)
    char_array->allocator.deallocate(char_array->buffer, char_array->allocator.state);
  }
  char_array->buffer = nullptr;
  char_array->buffer_length = char_array->buffer_capacity = 0;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_resize(rcutils_char_array_t* char_array, size_t new_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  if (new_size == 0) {
    RCUTILS_SET_ERROR_MSG("new size of char_array has to be greater than zero");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&char_array->allocator, "char array has no valid allocator",
                                   return RCUTILS_RET_ERROR)
  if (new_size == char_array->buffer_capacity) {
    return RCUTILS_RET_OK;
  }
  const rcutils_char_array_t old = *char_array;
  if (old.owns_buffer) {
    void* buffer = rcutils_reallocf(old.buffer, new_size, &char_array->allocator);
    if (buffer == nullptr) {
      *char_array = {nullptr, true, 0, 0, old.allocator};
      RCUTILS_SET_ERROR_MSG("failed to reallocate memory for char array");
      return RCUTILS_RET_BAD_ALLOC;
    }
    char_array->buffer = static_cast<char*>(buffer);
  } else {
    const rcutils_ret_t made = rcutils_char_array_init(char_array, new_size, &old.allocator);
    if (made != RCUTILS_RET_OK) {
      return made;
    }
    const size_t kept = std::min(new_size, old.buffer_capacity);
    if (kept != 0) {
      std::memcpy(char_array->buffer, old.buffer, kept);
      char_array->buffer[kept - 1] = '\0';
    }
  }
  char_array->buffer_capacity = new_size;
  char_array->buffer_length = std::min(new_size, old.buffer_length);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_expand_as_needed(rcutils_char_array_t* char_array, size_t new_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  const size_t capacity = char_array->buffer_capacity;
  // By half at least, so that texts that grow by small parts are copied seldom.
  return new_size <= capacity ? RCUTILS_RET_OK
                              : rcutils_char_array_resize(char_array, std::max(new_size, capacity + capacity / 2));
}

rcutils_ret_t rcutils_char_array_vsprintf(rcutils_char_array_t* char_array, const char* format, va_list args) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  const auto print = [&] {
    va_list copy;
    va_copy(copy, args);
    const int size = std::vsnprintf(char_array->buffer, char_array->buffer_capacity, format, copy);
    va_end(copy);
    return size;
  };
  const int size = print();
  if (size < 0) {
    RCUTILS_SET_ERROR_MSG("vsprintf on char array failed");
    return RCUTILS_RET_ERROR;
  }
  const size_t length = static_cast<size_t>(size) + 1;
  if (length > char_array->buffer_capacity) {
    const rcutils_ret_t result = rcutils_char_array_expand_as_needed(char_array, length);
    if (result != RCUTILS_RET_OK) {
      return result;
    }
    (void)print();
  }
  char_array->buffer_length = length;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_char_array_memcpy(rcutils_char_array_t* char_array, const char* src, size_t n) {
  const rcutils_ret_t result = rcutils_char_array_expand_as_needed(char_array, n);
  if (result == RCUTILS_RET_OK) {
    std::memcpy(char_array->buffer, src, n);
    char_array->buffer_length = n;
  }
  return result;
}

rcutils_ret_t rcutils_char_array_strcpy(rcutils_char_array_t* char_array, const char* src) {
  return rcutils_char_array_memcpy(char_array, src, std::strlen(src) + 1);
}

rcutils_ret_t rcutils_char_array_strncat(rcutils_char_array_t* char_array, const char* src, size_t n) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(char_array, RCUTILS_RET_ERROR);
  const size_t before = char_array->buffer_length == 0 ? 0 : char_array->buffer_length - 1;
  const rcutils_ret_t result = rcutils_char_array_expand_as_needed(char_array, before + n + 1);
  if (result == RCUTILS_RET_OK) {
    std::memcpy(char_array->buffer + before, src, n);
    char_array->buffer[before + n] = '\0';
    char_array->buffer_length = before + n + 1;
  }
  return result;
}

rcutils_ret_t rcutils_char_array_strcat(rcutils_char_array_t* char_array, const char* src) {
  return rcutils_char_array_strncat(char_array, src, std::strlen(src));
}
