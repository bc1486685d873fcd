// SPDX-License-Identifier: Apache-2.0
// Paths, files and directories. Functions that return a string return memory of the allocator, or null.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

bool rcutils_get_cwd(char* buffer, size_t max_length);
bool rcutils_is_directory(const char* abs_path);
bool rcutils_is_file(const char* abs_path);
bool rcutils_exists(const char* abs_path);
bool rcutils_is_readable(const char* abs_path);
bool rcutils_is_writable(const char* abs_path);
bool rcutils_is_readable_and_writable(const char* abs_path);

char* rcutils_join_path(const char* left_hand_path, const char* right_hand_path, rcutils_allocator_t allocator);
// On this system a copy.
char* rcutils_to_native_path(const char* path, rcutils_allocator_t allocator);
// Replaces a leading ~ by the home directory.
char* rcutils_expand_user(const char* path, rcutils_allocator_t allocator);

// True if the directory exists afterwards. The path must be absolute.
bool rcutils_mkdir(const char* abs_path);

// The bytes of the files in a directory; with recursion also of those below, down to `max_depth` levels (0: all).
rcutils_ret_t rcutils_calculate_directory_size(const char* directory_path, uint64_t* size,
                                               rcutils_allocator_t allocator);
rcutils_ret_t rcutils_calculate_directory_size_with_recursion(const char* directory_path, size_t max_depth,
                                                              uint64_t* size, rcutils_allocator_t allocator);
// What a directory holds, `.` and `..` included, in no order:
//   iter = rcutils_dir_iter_start(path, allocator);            null if it is no directory; the error is set
//   do { … iter->entry_name … } while (rcutils_dir_iter_next(iter));
//   rcutils_dir_iter_end(iter);
struct rcutils_dir_iter_state_s;
typedef struct rcutils_dir_iter_s {
  const char* entry_name;  // null after the last one
  rcutils_allocator_t allocator;
  struct rcutils_dir_iter_state_s* state;
} rcutils_dir_iter_t;

rcutils_dir_iter_t* rcutils_dir_iter_start(const char* directory_path, const rcutils_allocator_t allocator);
bool rcutils_dir_iter_next(rcutils_dir_iter_t* iter);
void rcutils_dir_iter_end(rcutils_dir_iter_t* iter);

// 0 if it is no file.
size_t rcutils_get_file_size(const char* file_path);

#ifdef __cplusplus
}
#endif
