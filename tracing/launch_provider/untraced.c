// SPDX-License-Identifier: Apache-2.0
/* Keeps a process out of every trace of userspace events: preloaded, it stands before LTTng-UST 2.13 (and later) where
   tracepoint providers register their probes, so that the process has no event that a session could enable. No
   environment variable of LTTng does this, for root's session daemon is found whatever LTTNG_HOME says, nor a tracker:
   it takes process ids, which are known when the process runs already. */

/* What a registration gives back must not be null, and is only handed back to the second function. */
static int nothing;

void* lttng_ust_probe_register(const void* description);
void lttng_ust_probe_unregister(void* probe);

void* lttng_ust_probe_register(const void* description) {
  (void)description;
  return &nothing;
}

void lttng_ust_probe_unregister(void* probe) {
  (void)probe;
}
