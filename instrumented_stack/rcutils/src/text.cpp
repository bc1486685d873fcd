// SPDX-License-Identifier: Apache-2.0
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "rcutils/cmdline_parser.h"
#include "rcutils/error_handling.h"
#include "rcutils/find.h"
#include "rcutils/qsort.h"
#include "rcutils/repl_str.h"
#include "rcutils/split.h"
#include "rcutils/strcasecmp.h"
#include "rcutils/strdup.h"
#include "rcutils/strerror.h"

namespace {

size_t place(size_t found) {
  return found == std::string_view::npos ? SIZE_MAX : found;
}

// Gives the strings to a new array.
rcutils_ret_t store(const std::vector<std::string_view>& parts, rcutils_allocator_t allocator,
                    rcutils_string_array_t* string_array) {
  if (parts.empty()) {
    *string_array = rcutils_get_zero_initialized_string_array();
    return RCUTILS_RET_OK;
  }
  const rcutils_ret_t made = rcutils_string_array_init(string_array, parts.size(), &allocator);
  if (made != RCUTILS_RET_OK) {
    return made;
  }
  for (size_t i = 0; i < parts.size(); ++i) {
    string_array->data[i] = rcutils_strndup(parts[i].data(), parts[i].size(), allocator);
    if (string_array->data[i] == nullptr) {
      (void)rcutils_string_array_fini(string_array);
      RCUTILS_SET_ERROR_MSG("no memory for the parts of a string");
      return RCUTILS_RET_BAD_ALLOC;
    }
  }
  return RCUTILS_RET_OK;
}

// Without one delimiter at either end.
std::string_view trimmed(const char* str, char delimiter) {
  std::string_view text = str == nullptr ? "" : str;
  if (!text.empty() && text.front() == delimiter) {
    text.remove_prefix(1);
  }
  if (!text.empty() && text.back() == delimiter) {
    text.remove_suffix(1);
  }
  return text;
}

}  // namespace

void rcutils_strerror(char* buffer, size_t buffer_length) {
  if (buffer_length == 0) {
    return;
  }
  char own[256];
  const char* const text = strerror_r(errno, own, sizeof own);  // GNU's, which may not use the buffer
  const size_t length = strnlen(text, buffer_length - 1);
  memcpy(buffer, text, length);
  buffer[length] = '\0';
}

int rcutils_strcasecmp(const char* s1, const char* s2, int* value) {
  if (s1 == nullptr || s2 == nullptr || value == nullptr) {
    return EINVAL;
  }
  *value = strcasecmp(s1, s2);
  return 0;
}

int rcutils_strncasecmp(const char* s1, const char* s2, size_t n, int* value) {
  if (s1 == nullptr || s2 == nullptr || value == nullptr) {
    return EINVAL;
  }
  *value = strncasecmp(s1, s2, n);
  return 0;
}

size_t rcutils_find(const char* str, char delimiter) {
  return str == nullptr ? SIZE_MAX : place(std::string_view(str).find(delimiter));
}
size_t rcutils_findn(const char* str, char delimiter, size_t string_length) {
  return str == nullptr ? SIZE_MAX : place(std::string_view(str, string_length).find(delimiter));
}
size_t rcutils_find_last(const char* str, char delimiter) {
  return str == nullptr ? SIZE_MAX : place(std::string_view(str).rfind(delimiter));
}
size_t rcutils_find_lastn(const char* str, char delimiter, size_t string_length) {
  return str == nullptr ? SIZE_MAX : place(std::string_view(str, string_length).rfind(delimiter));
}

rcutils_ret_t rcutils_split(const char* str, char delimiter, rcutils_allocator_t allocator,
                            rcutils_string_array_t* string_array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(string_array, RCUTILS_RET_INVALID_ARGUMENT);
  std::vector<std::string_view> parts;
  std::string_view rest = trimmed(str, delimiter);
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(delimiter), rest.size());
    if (end > 0) {
      parts.push_back(rest.substr(0, end));
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return store(parts, allocator, string_array);
}

rcutils_ret_t rcutils_split_last(const char* str, char delimiter, rcutils_allocator_t allocator,
                                 rcutils_string_array_t* string_array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(string_array, RCUTILS_RET_INVALID_ARGUMENT);
  const std::string_view text = trimmed(str, delimiter);
  std::vector<std::string_view> parts;
  const size_t last = text.rfind(delimiter);
  if (last == std::string_view::npos) {
    if (!text.empty()) {
      parts.push_back(text);
    }
  } else {
    std::string_view left = text.substr(0, last);
    if (!left.empty() && left.back() == delimiter) {
      left.remove_suffix(1);
    }
    parts = {left, text.substr(last + 1)};
  }
  return store(parts, allocator, string_array);
}

char* rcutils_repl_str(const char* str, const char* from, const char* to, const rcutils_allocator_t* allocator) {
  std::string result = str;
  const size_t length = strlen(from);
  for (size_t at = 0; length > 0 && (at = result.find(from, at)) != std::string::npos; at += strlen(to)) {
    result.replace(at, length, to);
  }
  return rcutils_strndup(result.c_str(), result.size(), *allocator);
}

rcutils_ret_t rcutils_qsort(void* ptr, size_t count, size_t size, int (*comp)(const void*, const void*)) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(comp, RCUTILS_RET_INVALID_ARGUMENT);
  if (count > 1) {
    RCUTILS_CHECK_ARGUMENT_FOR_NULL(ptr, RCUTILS_RET_INVALID_ARGUMENT);
    qsort(ptr, count, size, comp);
  }
  return RCUTILS_RET_OK;
}

bool rcutils_cli_option_exist(char** begin, char** end, const char* option) {
  return std::find(begin, end, std::string_view(option)) != end;
}

char* rcutils_cli_get_option(char** begin, char** end, const char* option) {
  char** const found = std::find(begin, end, std::string_view(option));
  return found != end && found + 1 != end ? found[1] : nullptr;
}
