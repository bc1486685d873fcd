// SPDX-License-Identifier: Apache-2.0
// Lets a signal end Python code that would run for ever. The launcher's loop reads signals, but not while it waits for
// Python.
#pragma once

namespace launch::python {

// Until the end of the block, a signal that asks the launcher to end interrupts Python, if the launcher has blocked the
// signal: about a second later Python code gets KeyboardInterrupt, once. Code that returns before that is not
// disturbed. The signal stays pending, so the loop reads it afterwards. Blocks may nest; the outermost one counts. The
// caller holds the interpreter's lock, in the thread of the loop.
class PythonInterrupt {
 public:
  PythonInterrupt();
  PythonInterrupt(const PythonInterrupt&) = delete;
  PythonInterrupt& operator=(const PythonInterrupt&) = delete;
  ~PythonInterrupt();

 private:
  bool outermost_;
};

}  // namespace launch::python
