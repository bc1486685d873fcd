// SPDX-License-Identifier: Apache-2.0
#include "rcutils/filesystem.h"

#include <dirent.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "rcutils/env.h"
#include "rcutils/error_handling.h"
#include "rcutils/strdup.h"

namespace fs = std::filesystem;

namespace {

char* copy_of(const std::string& text, rcutils_allocator_t allocator) {
  return rcutils_strndup(text.c_str(), text.size(), allocator);
}

bool has_access(const char* path, int mode) {
  return path != nullptr && access(path, mode) == 0;
}

}  // namespace

bool rcutils_get_cwd(char* buffer, size_t max_length) {
  return buffer != nullptr && max_length != 0 && getcwd(buffer, max_length) != nullptr;
}

bool rcutils_is_directory(const char* abs_path) {
  std::error_code error;
  return abs_path != nullptr && fs::is_directory(abs_path, error);
}
bool rcutils_is_file(const char* abs_path) {
  std::error_code error;
  return abs_path != nullptr && fs::is_regular_file(abs_path, error);
}
bool rcutils_exists(const char* abs_path) {
  std::error_code error;
  return abs_path != nullptr && fs::exists(abs_path, error);
}
bool rcutils_is_readable(const char* abs_path) {
  return has_access(abs_path, R_OK);
}
bool rcutils_is_writable(const char* abs_path) {
  return has_access(abs_path, W_OK);
}
bool rcutils_is_readable_and_writable(const char* abs_path) {
  return has_access(abs_path, R_OK | W_OK);
}

char* rcutils_join_path(const char* left_hand_path, const char* right_hand_path, rcutils_allocator_t allocator) {
  if (left_hand_path == nullptr || right_hand_path == nullptr) {
    return nullptr;
  }
  return copy_of(std::string(left_hand_path) + "/" + right_hand_path, allocator);
}

char* rcutils_to_native_path(const char* path, rcutils_allocator_t allocator) {
  return path == nullptr ? nullptr : copy_of(path, allocator);
}

char* rcutils_expand_user(const char* path, rcutils_allocator_t allocator) {
  if (path == nullptr) {
    return nullptr;
  }
  if (path[0] != '~') {
    return copy_of(path, allocator);
  }
  const char* const home = rcutils_get_home_dir();
  return home == nullptr ? nullptr : copy_of(std::string(home) + (path + 1), allocator);
}

bool rcutils_mkdir(const char* abs_path) {
  if (abs_path == nullptr || abs_path[0] != '/') {
    return false;
  }
  std::error_code error;
  fs::create_directory(abs_path, error);
  return rcutils_is_directory(abs_path);
}

rcutils_ret_t rcutils_calculate_directory_size(const char* directory_path, uint64_t* size,
                                               rcutils_allocator_t allocator) {
  return rcutils_calculate_directory_size_with_recursion(directory_path, 1, size, allocator);
}

rcutils_ret_t rcutils_calculate_directory_size_with_recursion(const char* directory_path, size_t max_depth,
                                                              uint64_t* size, rcutils_allocator_t) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(directory_path, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(size, RCUTILS_RET_INVALID_ARGUMENT);
  *size = 0;
  if (!rcutils_is_directory(directory_path)) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("'%s' is no directory", directory_path);
    return RCUTILS_RET_ERROR;
  }
  std::error_code error;
  for (fs::recursive_directory_iterator entry(directory_path, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_directory(error) && max_depth != 0 && static_cast<size_t>(entry.depth()) + 1 >= max_depth) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(error)) {
      *size += entry->file_size(error);
    }
  }
  return RCUTILS_RET_OK;
}

size_t rcutils_get_file_size(const char* file_path) {
  std::error_code error;
  return rcutils_is_file(file_path) ? static_cast<size_t>(fs::file_size(file_path, error)) : 0;
}

struct rcutils_dir_iter_state_s {
  DIR* directory;
};

rcutils_dir_iter_t* rcutils_dir_iter_start(const char* directory_path, const rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(directory_path, nullptr);
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "allocator is invalid", return nullptr)
  DIR* const directory = opendir(directory_path);
  if (directory == nullptr) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("cannot open directory '%s': %s", directory_path,
                                             std::generic_category().message(errno).c_str());
    return nullptr;
  }
  // Iterator and state in one piece of memory.
  struct Both {
    rcutils_dir_iter_t iterator;
    rcutils_dir_iter_state_s state;
  };
  auto* both = static_cast<Both*>(allocator.zero_allocate(1, sizeof(Both), allocator.state));
  if (both == nullptr) {
    closedir(directory);
    RCUTILS_SET_ERROR_MSG("out of memory for a directory iterator");
    return nullptr;
  }
  both->state.directory = directory;
  both->iterator = {nullptr, allocator, &both->state};
  (void)rcutils_dir_iter_next(&both->iterator);
  return &both->iterator;
}

bool rcutils_dir_iter_next(rcutils_dir_iter_t* iter) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(iter, false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(iter->state, "iter is invalid", return false);
  const dirent* const entry = readdir(iter->state->directory);
  iter->entry_name = entry == nullptr ? nullptr : entry->d_name;
  return entry != nullptr;
}

void rcutils_dir_iter_end(rcutils_dir_iter_t* iter) {
  if (iter != nullptr) {
    closedir(iter->state->directory);
    iter->allocator.deallocate(iter, iter->allocator.state);
  }
}
