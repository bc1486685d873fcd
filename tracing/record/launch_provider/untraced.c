// SPDX-License-Identifier: Apache-2.0
/* Keeps a process out of every trace of userspace events. This library is preloaded and comes before LTTng-UST 2.13
   (and later) when tracepoint providers register their probes, so the process has no event that a session could enable.
   No environment variable of LTTng does this: root's session daemon is found whatever LTTNG_HOME says. A tracker does
   not do it either: it takes process ids, which are known only when the process runs already. */

/* A registration must not return null. The result is only passed to the second function. */
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
