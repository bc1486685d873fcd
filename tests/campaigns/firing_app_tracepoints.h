// SPDX-License-Identifier: Apache-2.0
// The events of firing_app: each has the index of its thread and its number among the events of this thread.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER campaign
#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "firing_app_tracepoints.h"

#if !defined(FIRING_APP_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define FIRING_APP_TRACEPOINTS_H

#include <lttng/tracepoint.h>

LTTNG_UST_TRACEPOINT_EVENT_CLASS(campaign, event,
                                 LTTNG_UST_TP_ARGS(int, thread_index, unsigned long, event_number, const char*, filler),
                                 LTTNG_UST_TP_FIELDS(lttng_ust_field_integer(int, thread, thread_index)
                                                         lttng_ust_field_integer(unsigned long, number, event_number)
                                                             lttng_ust_field_string(text, filler)))

// Threads with even indices fire the one, those with odd indices the other, so that two channels can share them.
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(campaign, event, campaign, even,
                                    LTTNG_UST_TP_ARGS(int, thread_index, unsigned long, event_number, const char*,
                                                      filler))
LTTNG_UST_TRACEPOINT_EVENT_INSTANCE(campaign, event, campaign, odd,
                                    LTTNG_UST_TP_ARGS(int, thread_index, unsigned long, event_number, const char*,
                                                      filler))

#endif

#include <lttng/tracepoint-event.h>
