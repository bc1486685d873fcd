// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tracetools {

// Functions of liblttng-ust-tracepoint.so that attach a function to a tracepoint. The library exports them, and
// liblttng-ust.so calls them, but no public header declares them. lttng-ust 2.13 has them.
struct LttngFunctions {
  using Attach = int (*)(const char* provider, const char* event, void (*probe)(), void* data, const char* signature);
  using Detach = int (*)(const char* provider, const char* event, void (*probe)(), void* data);

  Attach attach = nullptr;
  Detach detach = nullptr;

  bool exist() const { return attach != nullptr && detach != nullptr; }
};

// Looked up once. Loads that library, which has no threads.
const LttngFunctions& lttng_functions();

}  // namespace tracetools
