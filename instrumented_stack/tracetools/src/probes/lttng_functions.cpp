// SPDX-License-Identifier: Apache-2.0
#include "probes/lttng_functions.hpp"

#include <dlfcn.h>
#include <lttng/ust-tracer.h>

namespace tracetools {
namespace {

LttngFunctions look_up() {
  void* const library = dlopen(LTTNG_UST_TRACEPOINT_LIB_SONAME, RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) {
    return {};
  }
  return {
      .attach = reinterpret_cast<LttngFunctions::Attach>(dlsym(library, "lttng_ust_tp_probe_register_queue_release")),
      .detach =
          reinterpret_cast<LttngFunctions::Detach>(dlsym(library, "lttng_ust_tp_probe_unregister_queue_release"))};
}

}  // namespace

const LttngFunctions& lttng_functions() {
  static const LttngFunctions functions = look_up();
  return functions;
}

}  // namespace tracetools
