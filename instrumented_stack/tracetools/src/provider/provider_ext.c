// SPDX-License-Identifier: Apache-2.0
/* The probes of provider `ros2_ext`, in libtracetools_provider.so like those of `ros2`. */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#include "provider/provider_ext.h"

const struct lttng_ust_probe_desc* tracetools_probes_of_ros2_ext(void) {
  return &lttng_ust__probe_desc___ros2_ext;
}
