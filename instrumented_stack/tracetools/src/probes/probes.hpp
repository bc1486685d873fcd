// SPDX-License-Identifier: Apache-2.0
#pragma once

// The probes of a tracepoint. LTTng attaches one for each channel that records the event, so an event can be recorded
// into one session alone. All structs are part of LTTng-UST's public interface.

#include <lttng/tracepoint.h>
#include <lttng/ust-events.h>

#include <cstdint>

namespace tracetools {

using Tracepoint = lttng_ust_tracepoint;
using Probe = lttng_ust_tracepoint_probe;
using Session = lttng_ust_session;

// While one exists, LTTng frees no probes, and no sessions that have probes.
class ProbesInUse {
 public:
  ProbesInUse() : locked_(LTTNG_UST_TP_RCU_LINK_TEST() != 0) {
    if (locked_) {
      lttng_ust_tp_rcu_read_lock();
    }
  }
  ~ProbesInUse() {
    if (locked_) {
      lttng_ust_tp_rcu_read_unlock();
    }
  }
  ProbesInUse(const ProbesInUse&) = delete;
  ProbesInUse& operator=(const ProbesInUse&) = delete;

  // The first probe; the last one is followed by one without a function. Null if there are none.
  const Probe* of(const Tracepoint& tracepoint) const {
    return locked_ ? __atomic_load_n(&tracepoint.probes, __ATOMIC_CONSUME) : nullptr;
  }

 private:
  bool locked_;
};

// Calls `use(probe)` for each probe of the tracepoint.
template <typename Use>
void for_each_probe(const ProbesInUse& probes, const Tracepoint& tracepoint, Use use) {
  const Probe* probe = probes.of(tracepoint);
  for (; probe != nullptr && probe->func != nullptr; ++probe) {
    use(*probe);
  }
}

// The session into which the probe records. Null for a probe that does something else, as that of a trigger.
Session* session_of(const Probe& probe);

inline bool records(const Session& session) {
  return CMM_LOAD_SHARED(session.active) != 0;
}

// Whether the session has a probe at the tracepoint.
bool has_probe(const ProbesInUse& probes, const Tracepoint& tracepoint, const Session* session);

// A probe that does nothing, at the end of the tracepoint's probes. LTTng appends new probes, and attaches the probes
// of a session anew when the session resumes. So a session whose probe is before the mark has not paused since.
class ProbeMark {
 public:
  // Puts the mark at the end, for the first time or again.
  static void move_to_end(const Tracepoint& tracepoint);
  // False if there is no mark.
  static bool is_after(const ProbesInUse& probes, const Tracepoint& tracepoint, const Session* session);
};

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
