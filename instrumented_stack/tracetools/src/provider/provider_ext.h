// SPDX-License-Identifier: Apache-2.0
/* The payload of every event of provider `ros2_ext`, from tracetools/event_table.h. provider.h explains the
 * unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2_ext

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider/provider_ext.h"

#if !defined(PROVIDER_EXT_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_EXT_H_

#include <lttng/tracepoint.h>

#include "provider/provider_fields.h"

TRACETOOLS_EXT_EVENT_TABLE(TRACETOOLS_PROBE, ros2_ext)

#endif /* PROVIDER_EXT_H_ */

#include <lttng/tracepoint-event.h>
