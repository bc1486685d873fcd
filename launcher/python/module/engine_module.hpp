// SPDX-License-Identifier: Apache-2.0
// The module `_launch_engine`: the launch that called Python, for the Python package `launch`.
#pragma once

#include <exception>

#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch::python {

// Makes `host` the launch that Python sees, until the end of the block. Calls may nest.
class CurrentHost {
 public:
  explicit CurrentHost(Host& host);
  CurrentHost(const CurrentHost&) = delete;
  CurrentHost& operator=(const CurrentHost&) = delete;
  ~CurrentHost();

 private:
  Host* outer_;
};

// What a call of the host threw, by the number that the Python exception for it carries; null for an unknown number.
std::exception_ptr host_failure(std::size_t number);

}  // namespace launch::python
