// SPDX-License-Identifier: Apache-2.0
// Provider `launch`: the steps of the launcher. `time` is the CLOCK_MONOTONIC time in nanoseconds at which the step
// happened or began, `duration` is in nanoseconds. Steps before the session exists are fired as soon as it does. `file`
// and `line` are the place in the launch file that asked for the step, "" and 0 when there is none.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER launch

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "tracepoints.h"

#if !defined(LAUNCH_PROVIDER_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define LAUNCH_PROVIDER_TRACEPOINTS_H

#include <lttng/tracepoint.h>
#include <stdint.h>

LTTNG_UST_TRACEPOINT_EVENT_CLASS(
    launch, step,
    LTTNG_UST_TP_ARGS(int64_t, time, int64_t, duration, const char*, name, const char*, file, uint32_t, line),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time)
                            lttng_ust_field_integer(int64_t, duration, duration) lttng_ust_field_string(name, name)
                                lttng_ust_field_string(file, file) lttng_ust_field_integer(uint32_t, line, line)))

LTTNG_UST_TRACEPOINT_EVENT_CLASS(launch, exit_class,
                                 LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, int32_t, pid, int32_t,
                                                   exit_code, const char*, file, uint32_t, line),
                                 LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time)
                                                         lttng_ust_field_string(process, process)
                                                             lttng_ust_field_integer(int32_t, pid, pid)
                                                                 lttng_ust_field_integer(int32_t, exit_code, exit_code)
                                                                     lttng_ust_field_string(file, file)
                                                                         lttng_ust_field_integer(uint32_t, line, line)))

// A launch file was read and checked.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(launch, step, launch, load,
                                    LTTNG_UST_TP_ARGS(int64_t, time, int64_t, duration, const char*, name, const char*,
                                                      file, uint32_t, line))

// Another launch file was included: read, checked and visited.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(launch, step, launch, include,
                                    LTTNG_UST_TP_ARGS(int64_t, time, int64_t, duration, const char*, name, const char*,
                                                      file, uint32_t, line))

// The actions of the launch file, or of a timer, were visited.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(launch, step, launch, visit,
                                    LTTNG_UST_TP_ARGS(int64_t, time, int64_t, duration, const char*, name, const char*,
                                                      file, uint32_t, line))

// The condition that a process waits for holds: its `depends_on` of this line.
LTTNG_UST_TRACEPOINT_EVENT(
    launch, ready,
    LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, const char*, condition, const char*, file, uint32_t, line),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time) lttng_ust_field_string(process, process)
                            lttng_ust_field_string(condition, condition) lttng_ust_field_string(file, file)
                                lttng_ust_field_integer(uint32_t, line, line)))

// A process is about to be started; it has no label until it runs.
LTTNG_UST_TRACEPOINT_EVENT(
    launch, spawn, LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, const char*, file, uint32_t, line),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time) lttng_ust_field_string(process, process)
                            lttng_ust_field_string(file, file) lttng_ust_field_integer(uint32_t, line, line)))

// The program of the process runs.
LTTNG_UST_TRACEPOINT_EVENT(
    launch, exec,
    LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, int32_t, pid, const char*, file, uint32_t, line),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time) lttng_ust_field_string(process, process)
                            lttng_ust_field_integer(int32_t, pid, pid) lttng_ust_field_string(file, file)
                                lttng_ust_field_integer(uint32_t, line, line)))

// The process has ended; -N when signal N ended it.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(launch, exit_class, launch, exit,
                                    LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, int32_t, pid, int32_t,
                                                      exit_code, const char*, file, uint32_t, line))

// The process has ended and will be started again.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(launch, exit_class, launch, respawn,
                                    LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, int32_t, pid, int32_t,
                                                      exit_code, const char*, file, uint32_t, line))

// A signal was sent to the process and its group.
LTTNG_UST_TRACEPOINT_EVENT(
    launch, signal,
    LTTNG_UST_TP_ARGS(int64_t, time, const char*, process, int32_t, signal_number, const char*, file, uint32_t, line),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time) lttng_ust_field_string(process, process)
                            lttng_ust_field_integer(int32_t, signal, signal_number) lttng_ust_field_string(file, file)
                                lttng_ust_field_integer(uint32_t, line, line)))

// A class of events was dropped from the trace, because recording cost more than max-overhead. From `time` on, `events`
// (a list of names) are no longer recorded. `rate` is that of all processes before the cut, in events a second; `share`
// is the share of a processor.
LTTNG_UST_TRACEPOINT_EVENT(
    launch, cut,
    LTTNG_UST_TP_ARGS(int64_t, time, const char*, event_class, const char*, events, uint64_t, rate, double, share),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int64_t, time, time) lttng_ust_field_string(event_class, event_class)
                            lttng_ust_field_string(events, events) lttng_ust_field_integer(uint64_t, rate, rate)
                                lttng_ust_field_float(double, share, share)))

#endif

#include <lttng/tracepoint-event.h>
