// SPDX-License-Identifier: Apache-2.0
// The launch that Python sees, and a way for the exceptions of its calls through Python.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
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

bool host_is_there();
// Throws std::runtime_error when there is no host.
Host& host();

// Keeps the exception that is being handled, and throws a Python exception that carries its number.
[[noreturn]] void throw_host_failure(const std::exception& error);
// The exception with this number, which a call of the host threw; null for an unknown number.
std::exception_ptr host_failure(std::size_t number);

// Runs a call of the host. An exception of the call becomes a Python exception that carries it.
template <typename Call>
auto guarded(Call call) {
  try {
    return call();
  } catch (const pybind11::error_already_set&) {
    throw;
  } catch (const std::exception& error) {
    throw_host_failure(error);
  }
}

}  // namespace launch::python
