// SPDX-License-Identifier: Apache-2.0
// Turns Python's exceptions into errors with a place, and lets a signal end Python code that would run for ever.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>

#include "launcher/python/interpreter/python_runtime.hpp"
#include "launcher/python/module/current_host.hpp"

namespace launch::python {

// The launcher's loop reads signals, but not while it waits for Python. Until the end of the block, a signal that asks
// the launcher to end interrupts Python, if the launcher has blocked the signal: about a second later Python code gets
// KeyboardInterrupt, once. Code that returns before that is not disturbed. The signal stays pending, so the loop reads
// it afterwards. Blocks may nest; the outermost one counts. The caller holds the interpreter's lock, in the thread of
// the loop.
class PythonInterrupt {
 public:
  PythonInterrupt();
  PythonInterrupt(const PythonInterrupt&) = delete;
  PythonInterrupt& operator=(const PythonInterrupt&) = delete;
  ~PythonInterrupt();

 private:
  bool outermost_;
};

// `place` is (file, line, begin, end), or None.
Place read_place(const pybind11::handle& place);

// Throws Error for a Python exception. It carries the traceback if `shows_tracebacks()` is set.
[[noreturn]] void throw_failure(pybind11::error_already_set& error);

bool& shows_tracebacks();

// Runs a call of Python while it holds the interpreter's lock, with `host` as the launch that Python sees. Throws
// Error.
template <typename Call>
auto run_python(Host& host, Call call) {
  const pybind11::gil_scoped_acquire lock;
  const CurrentHost current(host);
  const PythonInterrupt interrupt;
  try {
    return call();
  } catch (pybind11::error_already_set& error) {
    throw_failure(error);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(error.what(), {}, {}, {}, nullptr);
  }
}

}  // namespace launch::python
