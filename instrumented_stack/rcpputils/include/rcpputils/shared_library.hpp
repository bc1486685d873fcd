// SPDX-License-Identifier: Apache-2.0
// A shared library that is loaded while a program runs.
#pragma once

#include <rcutils/error_handling.h>
#include <rcutils/shared_library.h>

#include <stdexcept>
#include <string>

namespace rcpputils {

// Loaded from the constructor to unload_library() or the destructor.
class SharedLibrary {
 public:
  // Throws std::bad_alloc or std::runtime_error with the loader's message.
  explicit SharedLibrary(const std::string& library_path) {
    require_ok(rcutils_load_shared_library(&library_, library_path.c_str(), rcutils_get_default_allocator()));
  }
  virtual ~SharedLibrary() {
    if (rcutils_is_shared_library_loaded(&library_) && rcutils_unload_shared_library(&library_) != RCUTILS_RET_OK) {
      rcutils_reset_error();
    }
  }
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  // Throws std::runtime_error if it is not loaded.
  void unload_library() { require_ok(rcutils_unload_shared_library(&library_)); }

  bool has_symbol(const char* symbol_name) { return rcutils_has_symbol(&library_, symbol_name); }
  bool has_symbol(const std::string& symbol_name) { return has_symbol(symbol_name.c_str()); }
  // Throw std::runtime_error if there is no such symbol.
  void* get_symbol(const char* symbol_name) {
    void* const symbol = rcutils_get_symbol(&library_, symbol_name);
    if (symbol == nullptr) {
      fail();
    }
    return symbol;
  }
  void* get_symbol(const std::string& symbol_name) { return get_symbol(symbol_name.c_str()); }

  std::string get_library_path() {
    const rcutils_shared_library_t* const loaded = &library_;
    return loaded->library_path;
  }

 private:
  [[noreturn]] static void fail() {
    const std::string message = rcutils_get_error_string().str;
    rcutils_reset_error();
    throw std::runtime_error(message);
  }
  static void require_ok(rcutils_ret_t result) {
    if (result == RCUTILS_RET_BAD_ALLOC) {
      throw std::bad_alloc();
    }
    if (result != RCUTILS_RET_OK) {
      fail();
    }
  }

  rcutils_shared_library_t library_ = rcutils_get_zero_initialized_shared_library();
};

// "x" becomes "libx.so", with `debug` "libxd.so".
inline std::string get_platform_library_name(std::string library_name, bool debug = false) {
  return "lib" + library_name + (debug ? "d.so" : ".so");
}

}  // namespace rcpputils
