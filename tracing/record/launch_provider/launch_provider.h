// SPDX-License-Identifier: Apache-2.0
/* The functions of liblaunch_trace.so. The launcher opens this library when a session records, so that it has neither
   LTTng-UST nor its threads when no session does. */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum launch_trace_kind {
  LAUNCH_TRACE_LOAD,
  LAUNCH_TRACE_INCLUDE,
  LAUNCH_TRACE_VISIT,
  LAUNCH_TRACE_READY,
  LAUNCH_TRACE_SPAWN,
  LAUNCH_TRACE_EXEC,
  LAUNCH_TRACE_EXIT,
  LAUNCH_TRACE_RESPAWN,
  LAUNCH_TRACE_SIGNAL,
  LAUNCH_TRACE_SCHEDULING,
  LAUNCH_TRACE_CONDITION
};

struct launch_trace_event {
  enum launch_trace_kind kind;
  int64_t time;     /* CLOCK_MONOTONIC, ns */
  int64_t duration; /* ns */
  const char* name; /* a path, a process label or a condition */
  const char* what; /* a condition or a change */
  const char* file;
  uint32_t line;
  int32_t pid;
  int32_t value; /* an exit code or a signal */
};

/* Fires the event of provider `launch` of this kind. Callable from any thread, does not block. */
void launch_trace_fire(const struct launch_trace_event* event);

typedef void (*launch_trace_fire_function)(const struct launch_trace_event*);

/* Whether a session records the launcher's events. Not before the session daemon has registered this process, which may
   take seconds on a busy machine. Callable from any thread, does not block. */
int launch_trace_enabled(void);

typedef int (*launch_trace_enabled_function)(void);

struct launch_trace_cut_event {
  int64_t time;            /* CLOCK_MONOTONIC, ns */
  const char* event_class; /* that was dropped */
  const char* events;      /* their names, with blanks between */
  uint64_t rate;           /* events a second, before it */
  double share;            /* of a processor that they cost */
};

/* Fires launch:cut. Callable from any thread, does not block. */
void launch_trace_cut(const struct launch_trace_cut_event* cut);

typedef void (*launch_trace_cut_function)(const struct launch_trace_cut_event*);

#ifdef __cplusplus
}
#endif
