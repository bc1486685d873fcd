// SPDX-License-Identifier: Apache-2.0
// How the readers of arguments and of parameter files refuse what they read.
#pragma once

#include <stdexcept>
#include <string>

namespace rcl {

[[noreturn]] inline void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

}  // namespace rcl
