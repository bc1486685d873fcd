// SPDX-License-Identifier: Apache-2.0
// The environment in which a program takes a library in place of another one of the same name.
#pragma once

#include <cstdlib>
#include <map>
#include <string>

namespace test_support {

// AddressSanitizer asks to be the first library, which it can't be before a preloaded one.
inline std::map<std::string, std::string> preloading(const std::string& library) {
  const char* options = std::getenv("ASAN_OPTIONS");
  return {{"LD_PRELOAD", library},
          {"ASAN_OPTIONS", std::string(options != nullptr ? options : "") + ":verify_asan_link_order=0"}};
}

}  // namespace test_support
