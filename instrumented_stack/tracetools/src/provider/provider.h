// SPDX-License-Identifier: Apache-2.0
/* The payload of every event of provider `ros2`, from tracetools/event_table.h.
 *
 * LTTng reads this file several times with different definitions of its macros, hence the unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider/provider.h"

#if !defined(PROVIDER_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_H_

#include <lttng/tracepoint.h>

#include "provider/provider_fields.h"

TRACETOOLS_EVENT_TABLE(TRACETOOLS_PROBE, ros2)

#endif /* PROVIDER_H_ */

#include <lttng/tracepoint-event.h>
