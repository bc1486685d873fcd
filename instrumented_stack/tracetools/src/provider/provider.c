// SPDX-License-Identifier: Apache-2.0
/* libtracetools_provider.so: the probes. Written in C, because LTTng's probe macros are not C++. */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#include "provider/provider.h"

#include "provider/provider_deadline.h"
#include "provider/provider_ext.h"
#include "provider/provider_session.h"

const struct lttng_ust_probe_desc* tracetools_probes_of_ros2(void) {
  return &lttng_ust__probe_desc___ros2;
}

const struct lttng_ust_probe_desc* tracetools_probes_of_ros2_ext(void) {
  return &lttng_ust__probe_desc___ros2_ext;
}
