// SPDX-License-Identifier: Apache-2.0
// How the readers of values, names and files report errors in their input.
#pragma once

#include <stdexcept>
#include <string>

namespace rcl_yaml {

[[noreturn]] inline void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

}  // namespace rcl_yaml
