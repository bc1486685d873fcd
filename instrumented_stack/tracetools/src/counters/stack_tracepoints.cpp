// SPDX-License-Identifier: Apache-2.0
#include "counters/stack_tracepoints.hpp"

#include "provider/provider.h"
#include "provider/provider_ext.h"

namespace tracetools {
namespace {

#define STACK_TRACEPOINT(provider, name, Struct, group, ...) {#group, &lttng_ust_tracepoint_##provider##___##name},
// Complete before any constructor runs: the one that opens the provider uses it.
constinit const StackTracepoint kTracepoints[] = {TRACETOOLS_EVENT_TABLE(STACK_TRACEPOINT, ros2)
                                                      TRACETOOLS_EXT_EVENT_TABLE(STACK_TRACEPOINT, ros2_ext)};
#undef STACK_TRACEPOINT

}  // namespace

std::span<const StackTracepoint> stack_tracepoints() {
  return kTracepoints;
}

void enable_without_probes(bool enabled) {
  for (const StackTracepoint& each : kTracepoints) {
    if (CMM_LOAD_SHARED(each.tracepoint->probes) == nullptr) {
      __atomic_store_n(&each.tracepoint->state, enabled ? 1 : 0, __ATOMIC_RELAXED);
    }
  }
}

}  // namespace tracetools
