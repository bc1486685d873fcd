// SPDX-License-Identifier: Apache-2.0
// The name of the current thread, as debuggers and traces show it.
#pragma once

#include <pthread.h>

#include <string>
#include <system_error>

namespace rcpputils {

// Linux keeps the first 15 bytes. Throws std::system_error if it refuses them.
inline void set_thread_name(const std::string& name) {
  constexpr std::size_t kMost = 15;
  if (const int error = pthread_setname_np(pthread_self(), name.substr(0, kMost).c_str())) {
    throw std::system_error(error, std::system_category(), "failed to set the name of a thread");
  }
}

// Throws std::system_error if the name can't be read.
inline std::string get_thread_name() {
  char name[16] = {};
  if (const int error = pthread_getname_np(pthread_self(), name, sizeof(name))) {
    throw std::system_error(error, std::system_category(), "failed to get the name of a thread");
  }
  return name;
}

}  // namespace rcpputils
