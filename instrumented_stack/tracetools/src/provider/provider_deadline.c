// SPDX-License-Identifier: Apache-2.0
/* The probes of provider `ros2_deadline`, in libtracetools_provider.so like those of `ros2`. */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#include "provider/provider_deadline.h"
