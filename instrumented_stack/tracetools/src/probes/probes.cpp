// SPDX-License-Identifier: Apache-2.0
#include "probes/probes.hpp"

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

// At its place a probe of LTTng has its data. So no other code mistakes it for one.
void do_nothing(void* /*data*/) {}

bool is_mark(const Probe& probe) {
  return probe.func == reinterpret_cast<void (*)()>(&do_nothing);
}

}  // namespace

Session* session_of(const Probe& probe) {
  if (is_mark(probe)) {
    return nullptr;
  }
  const auto* const event = static_cast<const lttng_ust_event_common*>(probe.data);
  if (event->type != LTTNG_UST_EVENT_TYPE_RECORDER) {
    return nullptr;
  }
  return static_cast<const lttng_ust_event_recorder*>(event->child)->chan->parent->session;
}

bool has_probe(const ProbesInUse& probes, const Tracepoint& tracepoint, const Session* session) {
  bool found = false;
  for_each_probe(probes, tracepoint, [&](const Probe& probe) { found = found || session_of(probe) == session; });
  return found;
}

void ProbeMark::move_to_end(const Tracepoint& tracepoint) {
  const LttngFunctions& lttng = lttng_functions();
  const auto function = reinterpret_cast<void (*)()>(&do_nothing);
  lttng.detach(tracepoint.provider_name, tracepoint.event_name, function, nullptr);
  lttng.attach(tracepoint.provider_name, tracepoint.event_name, function, nullptr, tracepoint.signature);
}

bool ProbeMark::is_after(const ProbesInUse& probes, const Tracepoint& tracepoint, const Session* session) {
  bool seen = false;
  bool after = false;
  for_each_probe(probes, tracepoint, [&](const Probe& probe) {
    if (is_mark(probe)) {
      after = seen;
    } else {
      seen = seen || session_of(probe) == session;
    }
  });
  return after;
}

const LttngFunctions& lttng_functions() {
  static const LttngFunctions functions = look_up();
  return functions;
}

}  // namespace tracetools
