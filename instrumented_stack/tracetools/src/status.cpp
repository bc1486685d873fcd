// SPDX-License-Identifier: Apache-2.0
// Tells whether a process that starts in this environment can be traced: exit status 0 if so, 1 if not.
#include <cstdio>

#include "tracetools/tracetools.h"

int main() {
#ifndef TRACETOOLS_DISABLED
  if (ros_trace_compile_status() && ros_trace_runtime_status()) {
    std::puts("Tracing enabled");
    return 0;
  }
  if (!ros_trace_compile_status()) {
    std::puts("Tracing disabled through configuration");
    return 1;
  }
  std::puts("Tracing disabled");
#else
  std::puts("Tracing disabled through configuration");
#endif
  return 1;
}
