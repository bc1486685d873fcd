// SPDX-License-Identifier: Apache-2.0
/* Provider `ros2_session`: events that are never fired. A rule for one of them tells the processes something about the
 * session. provider.h explains the unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2_session

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider/provider_session.h"

#if !defined(PROVIDER_SESSION_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_SESSION_H_

#include <lttng/tracepoint.h>

/* clang-format off */

/* No state dumps into this session: another session has the objects that lived before. */
LTTNG_UST_TRACEPOINT_EVENT(ros2_session, no_state_dump, LTTNG_UST_TP_ARGS(), LTTNG_UST_TP_FIELDS())

/* Only rules with a wildcard take this event. */
LTTNG_UST_TRACEPOINT_EVENT(ros2_session, any, LTTNG_UST_TP_ARGS(), LTTNG_UST_TP_FIELDS())

/* clang-format on */

#endif /* PROVIDER_SESSION_H_ */

#include <lttng/tracepoint-event.h>
