// SPDX-License-Identifier: Apache-2.0
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <algorithm>

#include "rcutils/format_string.h"
#include "rcutils/snprintf.h"
#include "rcutils/strdup.h"

int rcutils_vsnprintf(char* buffer, size_t buffer_size, const char* format, va_list args) {
  if (format == nullptr || (buffer == nullptr) != (buffer_size == 0)) {
    errno = EINVAL;
    return -1;
  }
  return vsnprintf(buffer, buffer_size, format, args);
}

int rcutils_snprintf(char* buffer, size_t buffer_size, const char* format, ...) {
  va_list args;
  va_start(args, format);
  const int length = rcutils_vsnprintf(buffer, buffer_size, format, args);
  va_end(args);
  return length;
}

char* rcutils_strndup(const char* str, size_t string_length, rcutils_allocator_t allocator) {
  if (str == nullptr || !rcutils_allocator_is_valid(&allocator)) {
    return nullptr;
  }
  const size_t length = strnlen(str, string_length);
  char* const copy = static_cast<char*>(allocator.allocate(length + 1, allocator.state));
  if (copy != nullptr) {
    memcpy(copy, str, length);
    copy[length] = '\0';
  }
  return copy;
}

char* rcutils_strdup(const char* str, rcutils_allocator_t allocator) {
  return str == nullptr ? nullptr : rcutils_strndup(str, strlen(str), allocator);
}

char* rcutils_format_string_limit(rcutils_allocator_t allocator, size_t limit, const char* format_string, ...) {
  if (format_string == nullptr || limit == 0 || !rcutils_allocator_is_valid(&allocator)) {
    return nullptr;
  }
  va_list args;
  va_start(args, format_string);
  va_list again;
  va_copy(again, args);
  const int length = vsnprintf(nullptr, 0, format_string, args);
  va_end(args);
  char* text = nullptr;
  if (length >= 0) {
    const size_t size = std::min(limit, static_cast<size_t>(length) + 1);
    text = static_cast<char*>(allocator.allocate(size, allocator.state));
    if (text != nullptr) {
      vsnprintf(text, size, format_string, again);
    }
  }
  va_end(again);
  return text;
}
