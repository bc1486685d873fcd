// SPDX-License-Identifier: Apache-2.0
#include "launch_provider.h"

#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include "tracepoints.h"

__attribute__((visibility("default"))) void launch_trace_fire(const struct launch_trace_event* e) {
  switch (e->kind) {
    case LAUNCH_TRACE_LOAD:
      lttng_ust_tracepoint(launch, load, e->time, e->duration, e->name, e->file, e->line);
      break;
    case LAUNCH_TRACE_INCLUDE:
      lttng_ust_tracepoint(launch, include, e->time, e->duration, e->name, e->file, e->line);
      break;
    case LAUNCH_TRACE_VISIT:
      lttng_ust_tracepoint(launch, visit, e->time, e->duration, e->name, e->file, e->line);
      break;
    case LAUNCH_TRACE_READY:
      lttng_ust_tracepoint(launch, ready, e->time, e->name, e->what, e->file, e->line);
      break;
    case LAUNCH_TRACE_SPAWN:
      lttng_ust_tracepoint(launch, spawn, e->time, e->name, e->file, e->line);
      break;
    case LAUNCH_TRACE_EXEC:
      lttng_ust_tracepoint(launch, exec, e->time, e->name, e->pid, e->file, e->line);
      break;
    case LAUNCH_TRACE_EXIT:
      lttng_ust_tracepoint(launch, exit, e->time, e->name, e->pid, e->value, e->file, e->line);
      break;
    case LAUNCH_TRACE_RESPAWN:
      lttng_ust_tracepoint(launch, respawn, e->time, e->name, e->pid, e->value, e->file, e->line);
      break;
    case LAUNCH_TRACE_SIGNAL:
      lttng_ust_tracepoint(launch, signal, e->time, e->name, e->value, e->file, e->line);
      break;
    case LAUNCH_TRACE_SCHEDULING:
      lttng_ust_tracepoint(launch, scheduling, e->time, e->name, e->what, e->file, e->line);
      break;
    case LAUNCH_TRACE_CONDITION:
      lttng_ust_tracepoint(launch, condition, e->time, e->name, e->what, e->file, e->line);
      break;
  }
}

// One rule, launch:*, enables all.
__attribute__((visibility("default"))) int launch_trace_enabled(void) {
  return lttng_ust_tracepoint_enabled(launch, exec) ? 1 : 0;
}

__attribute__((visibility("default"))) void launch_trace_cut(const struct launch_trace_cut_event* cut) {
  lttng_ust_tracepoint(launch, cut, cut->time, cut->event_class, cut->events, cut->rate, cut->share);
}
