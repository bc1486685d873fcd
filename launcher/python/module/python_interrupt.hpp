// SPDX-License-Identifier: Apache-2.0
// Lets a signal end Python code that would run for ever. The launcher's loop reads signals, but not while it waits for
// Python.
#pragma once

#include <signal.h>

#include <array>

namespace launch::python {

// Until the end of the block, a signal that asks the launcher to end interrupts Python, if the launcher has blocked the
// signal: a second later Python code gets KeyboardInterrupt. Code that returns before that is not disturbed. The signal
// itself is sent again at the end of the block, so the loop reads it then. Blocks may nest; the outermost one counts.
// The caller holds the interpreter's lock, in the thread of the loop.
class PythonInterrupt {
 public:
  PythonInterrupt();
  PythonInterrupt(const PythonInterrupt&) = delete;
  PythonInterrupt& operator=(const PythonInterrupt&) = delete;
  ~PythonInterrupt();

 private:
  static constexpr std::array<int, 4> kSignals{SIGHUP, SIGINT, SIGQUIT, SIGTERM};

  bool outermost_ = false;
  sigset_t unblocked_{};  // by this block
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace launch::python
