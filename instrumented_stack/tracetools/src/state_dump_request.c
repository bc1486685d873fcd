// SPDX-License-Identifier: Apache-2.0
/* lttng-ust records the state of a process (which files are loaded where) for each session that starts. It begins with
 * the tracepoint lttng_ust_statedump:start. It has no public hook for the state of applications. But any function can
 * be attached to a tracepoint, and this one fires in every process, so we need no thread and no polling.
 *
 * liblttng-ust-tracepoint.so exports the function that attaches, and liblttng-ust.so calls it. No public header
 * declares it, so we look it up. lttng-ust 2.13 has it; without it there are no state dumps. */
#include "state_dump_request.h"

#include <dlfcn.h>
#include <stdatomic.h>
#include <stddef.h>

typedef int (*register_probe)(const char* provider, const char* event, void (*probe)(void), void* data,
                              const char* signature);

static void (*_Atomic dump_state)(void);

/* Called once for each session that starts. */
static void on_lttng_ust_statedump_start(void* data, void* session) {
  (void)data;
  (void)session;
  atomic_load (&dump_state)();
}

int tracetools_provider_on_state_dump(void (*dump)(void)) {
  register_probe attach = (register_probe)dlsym(RTLD_DEFAULT, "lttng_ust_tp_probe_register_queue_release");
  if (attach == NULL) {
    return -1;
  }
  atomic_store(&dump_state, dump);
  /* The signature must equal the text in the tracepoint exactly. */
  return attach("lttng_ust_statedump", "start", (void (*)(void))on_lttng_ust_statedump_start, NULL,
                "struct lttng_ust_session *, session");
}
