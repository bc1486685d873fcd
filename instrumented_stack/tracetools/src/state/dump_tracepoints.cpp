// SPDX-License-Identifier: Apache-2.0
#include "state/dump_tracepoints.hpp"

#include <string_view>

#include "counters/stack_tracepoints.hpp"
#include "provider/provider.h"
#include "provider/provider_ext.h"
#include "provider/provider_session.h"
#include "state/init_event.hpp"

namespace tracetools {
namespace {

template <typename Recorder>
void record(const Recorder& recorder, const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  bool recorded = false;
  for_each_probe(probes, *recorder.tracepoint, [&](const Probe& probe) {
    if (session_of(probe) != session) {
      return;
    }
    recorder(probe, events);
    recorded = true;
  });
  if (recorded) {
    count(recorder.counted);
  }
}

}  // namespace

const Tracepoint* recorded_init_tracepoint(const ProbesInUse& probes, const Session* session) {
  for (const StackTracepoint& each : stack_tracepoints()) {
    if (std::string_view(each.group) == "init" && has_probe(probes, *each.tracepoint, session)) {
      return each.tracepoint;
    }
  }
  return nullptr;
}

bool wants_no_dump(const ProbesInUse& probes, const Session* session) {
  return has_probe(probes, lttng_ust_tracepoint_ros2_session___no_state_dump, session) &&
         !has_probe(probes, lttng_ust_tracepoint_ros2_session___any, session);
}

void record_dump_begin(const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  record(TRACETOOLS_RECORDER(ros2_ext, state_dump_begin), probes, session, events);
}

void record_dump_end(const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  record(TRACETOOLS_RECORDER(ros2_ext, state_dump_end), probes, session, events);
}

}  // namespace tracetools
