// SPDX-License-Identifier: Apache-2.0
// lttng-ust records the state of a process (which files are loaded where) into each session that starts. It begins
// with the tracepoint lttng_ust_statedump:start, which has the session as its argument. It has no public hook for the
// state of applications. But any function can be attached to a tracepoint, and this one fires in every process, so we
// need no thread and no polling.
#include "state/state_dump_request.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "counters/stack_tracepoints.hpp"

namespace tracetools {
namespace {

std::atomic<void (*)(Session*, bool)> dump_state{nullptr};

// The sessions that have asked before LTTng knew the events of the provider. Never destroyed, because LTTng's thread
// runs to the end of the process.
struct Early {
  std::mutex mutex;
  bool may_dump = false;
  std::vector<Session*> sessions;
};

Early& early() {
  static auto* early = new Early;
  return *early;
}

void on_lttng_ust_statedump_start(void* /*data*/, Session* session) {
  {
    const std::lock_guard lock(early().mutex);
    if (!early().may_dump) {
      early().sessions.push_back(session);
      return;
    }
  }
  dump_state.load()(session, true);
}

}  // namespace

void begin_state_dumps() {
  std::vector<Session*> sessions;
  {
    const std::lock_guard lock(early().mutex);
    early().may_dump = true;
    sessions.swap(early().sessions);
  }
  // A session that has ended meanwhile has no probes, so nothing is done for it.
  for (Session* const session : sessions) {
    dump_state.load()(session, false);
  }
}

void dump_to_sessions_before() {
  std::vector<Session*> sessions;
  {
    const ProbesInUse probes;
    for (const StackTracepoint& each : stack_tracepoints()) {
      for_each_probe(probes, *each.tracepoint, [&](const Probe& probe) {
        Session* const session = session_of(probe);
        if (session != nullptr && records(*session) &&
            std::find(sessions.begin(), sessions.end(), session) == sessions.end()) {
          sessions.push_back(session);
        }
      });
    }
  }
  for (Session* const session : sessions) {
    dump_state.load()(session, false);
  }
}

bool on_state_dump(void (*dump)(Session* session, bool lives)) {
  if (!lttng_functions().exist()) {
    return false;
  }
  dump_state = dump;
  // The signature must equal the text in the tracepoint exactly.
  return lttng_functions().attach("lttng_ust_statedump", "start",
                                  reinterpret_cast<void (*)()>(&on_lttng_ust_statedump_start), nullptr,
                                  "struct lttng_ust_session *, session") == 0;
}

}  // namespace tracetools
