// SPDX-License-Identifier: Apache-2.0
#include "probes/probes.hpp"

#include "probes/lttng_functions.hpp"

namespace tracetools {
namespace {

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

}  // namespace tracetools
