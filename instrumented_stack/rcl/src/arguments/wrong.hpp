// SPDX-License-Identifier: Apache-2.0
// How the readers of arguments and of parameter files report errors in their input.
#pragma once

#include <stdexcept>
#include <string>

namespace rcl {

[[noreturn]] inline void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

}  // namespace rcl
