// SPDX-License-Identifier: Apache-2.0
/// lttng-ust records the state of a process (which files are loaded where) into each session that starts. It begins
/// with the tracepoint lttng_ust_statedump:start, which has the session as its argument. It has no public hook for the
/// state of applications. But any function can be attached to a tracepoint, and this one fires in every process, so we
/// need no thread and no polling.
#include "state/state_dump_request.hpp"

#include <atomic>

#include "probes/lttng_functions.hpp"

namespace tracetools {
namespace {

std::atomic<void (*)(Session*)> dump_state{nullptr};

void on_lttng_ust_statedump_start(void* /*data*/, Session* session) {
  dump_state.load()(session);
}

}  // namespace

bool on_state_dump(void (*dump)(Session* session)) {
  if (!lttng_functions().exist()) return false;
  dump_state = dump;
  // The signature must equal the text in the tracepoint exactly.
  return lttng_functions().attach("lttng_ust_statedump", "start",
                                  reinterpret_cast<void (*)()>(&on_lttng_ust_statedump_start), nullptr,
                                  "struct lttng_ust_session *, session") == 0;
}

}  // namespace tracetools
